// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz targets do with their input; the plain tests replay the corpora through the same functions.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

#include "base/check.h"
#include "render/compare_pictures.h"
#include "render/draw_frame.h"

namespace sonar::fuzz {

/// Four bytes, the first the largest.
inline std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[at + i]); };
  return byte(0) << 24U | byte(1) << 16U | byte(2) << 8U | byte(3);
}

/// Whether a header, if it is one, asks for a picture that a few bytes make too slow for a fuzzer: it is allowed to have
/// 2^27 pixels.
inline bool slow_png(std::span<const std::byte> bytes) {
  if (bytes.size() < 24) return false;
  return std::uint64_t{big_endian(bytes, 16)} * big_endian(bytes, 20) > 1'000'000;
}

/// Colours are kept multiplied by alpha: what is nearly clear loses some of its own when it is written.
inline bool same_where_opaque(const Image& a, const Image& b) {
  return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                    [](Rgba8 p, Rgba8 q) { return p.a == q.a && (p.a < 255 || p == q); });
}

inline void put(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  SONAR_CHECK(out.good());
}

/// A picture that is taken has its pixels, is equal to itself, and is the same when it is written and read again.
/// folder  to write into: the reader takes files
inline void png(std::span<const std::byte> bytes, const std::filesystem::path& folder) {
  if (slow_png(bytes)) return;
  const std::filesystem::path file = folder / "picture.png";
  put(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const auto image = read_png(file);
  if (!image) {
    SONAR_CHECK(image.error().code == ErrorCode::format);
    return;
  }
  SONAR_CHECK(image->size.width > 0 && image->size.height > 0 && image->pixels.size() == image->size.count());
  SONAR_CHECK(compare_pictures(*image, *image, {}).equal);
  const auto written = png_bytes(*image);
  SONAR_CHECK(written.has_value());
  put(file, *written);
  const auto again = read_png(file);
  SONAR_CHECK(again.has_value() && again->size == image->size);
  SONAR_CHECK(same_where_opaque(*image, *again));
}

}  // namespace sonar::fuzz
