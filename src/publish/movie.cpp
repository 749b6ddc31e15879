// SPDX-License-Identifier: Apache-2.0
// Animated PNG (APNG 1.0): the chunks of single pictures, each behind a chunk that says when it is shown. Pixels are
// copied as they are compressed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "publish/picture_output.h"
#include "render/png_chunks.h"

namespace sonar {
namespace {

/// fcTL: the whole picture, shown so long, over what was there.
std::string frame_control(std::uint32_t sequence, std::string_view header, double frame_s) {
  constexpr std::uint32_t kPerSecond = 1000;
  const auto delay = static_cast<std::uint32_t>(std::clamp(std::lround(frame_s * kPerSecond), 1L, 65535L));
  return png_number(sequence) + std::string(header.substr(0, 8)) + png_number(0) + png_number(0) +
         png_number(delay, 2) + png_number(kPerSecond, 2) + std::string(2, '\0');
}

}  // namespace

Result<void> write_movie(std::span<const std::filesystem::path> pictures, double frame_s,
                         const std::filesystem::path& file) {
  if (pictures.empty()) return fail(ErrorCode::usage, "a movie needs pictures", {file.string()});
  if (file.extension() != ".png") return fail(ErrorCode::usage, "expected a name that ends in .png", {file.string()});
  std::string movie(kPngSignature);
  std::string header;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto bytes = read_file(pictures[i]);
    if (!bytes) return pass_on(bytes);
    const auto chunks = png_chunks(*bytes, pictures[i].string());
    if (!chunks) return pass_on(chunks);
    const std::string_view own = chunks->front().data;
    if (i == 0) {
      header = std::string(own);
      add_png_chunk(movie, "IHDR", header);
      add_png_chunk(movie, "acTL", png_number(static_cast<std::uint32_t>(pictures.size())) + png_number(0));
    }
    if (own != header)
      return fail(ErrorCode::mismatch, "another size than the pictures before", {pictures[i].string()});
    add_png_chunk(movie, "fcTL", frame_control(sequence++, header, frame_s));
    for (const PngChunk& chunk : *chunks) {
      if (chunk.type != "IDAT") continue;
      // The first picture is a plain one, for programs that know nothing of movies.
      i == 0 ? add_png_chunk(movie, "IDAT", chunk.data)
             : add_png_chunk(movie, "fdAT", png_number(sequence++) + std::string(chunk.data));
    }
  }
  add_png_chunk(movie, "IEND", {});
  return write_file(file, movie);
}

}  // namespace sonar
