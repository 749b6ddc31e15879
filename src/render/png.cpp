// SPDX-License-Identifier: Apache-2.0
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "render/cairo_values.h"
#include "render/draw_frame.h"

namespace sonar {
namespace {

constexpr std::uint32_t kMostPixels = 16384;          ///< a side
constexpr std::uint64_t kMostInAll = 134'217'728;     ///< 2^27: half a GiB
constexpr std::uintmax_t kMostBytes = 1'073'741'824;  ///< of a file
constexpr std::size_t kHeader = 33;                   ///< signature and IHDR

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

struct Reader {
  const std::string* bytes = nullptr;
  std::size_t next = 0;
};

cairo_status_t take(void* reader, unsigned char* to, unsigned int count) {
  auto& r = *static_cast<Reader*>(reader);
  if (count > r.bytes->size() - r.next) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(to, r.bytes->data() + r.next, count);
  r.next += count;
  return CAIRO_STATUS_SUCCESS;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out = out << 8U | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

/// What can be refused before a decoder sees it: no PNG, or one that asks for more memory than any picture of ours.
Result<void> check_header(const std::string& bytes, const std::string& file) {
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  if (bytes.size() < kHeader || std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) != 0 ||
      bytes.compare(12, 4, "IHDR") != 0) {
    return fail(ErrorCode::format, "not a PNG picture: expected its signature and header", {file, 0});
  }
  const std::uint32_t width = big_endian(bytes, 16);
  const std::uint32_t height = big_endian(bytes, 20);
  if (width == 0 || height == 0 || width > kMostPixels || height > kMostPixels ||
      std::uint64_t{width} * height > kMostInAll) {
    return fail(ErrorCode::format,
                fmt::format("a picture of {} x {} pixels; expected 1 to {} a side", width, height, kMostPixels),
                {file, 16});
  }
  return {};
}

Result<std::string> file_bytes(const std::filesystem::path& file) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return fail(ErrorCode::io, fmt::format("cannot be read: {}", code.message()), {file.string()});
  if (size > kMostBytes) return fail(ErrorCode::format, "too large for a picture", {file.string()});
  std::ifstream in(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) return fail(ErrorCode::io, "cannot be read", {file.string()});
  return bytes;
}

}  // namespace

Result<std::string> png_bytes(const Image& image) {
  if (image.size.width <= 0 || image.size.height <= 0 || image.pixels.size() != image.size.count()) {
    return fail(ErrorCode::bad_parameter, "a picture without pixels cannot be written");
  }
  const CairoSurface surface = surface_of(image);
  std::string bytes;
  if (surface == nullptr || cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS) {
    return fail(ErrorCode::io, "the picture could not be made a PNG");
  }
  return bytes;
}

Result<Image> read_png(const std::filesystem::path& file) {
  const auto bytes = file_bytes(file);
  if (!bytes) return pass_on(bytes);
  if (auto ok = check_header(*bytes, file.string()); !ok) return pass_on(ok);
  Reader reader{&*bytes};
  const CairoSurface surface(cairo_image_surface_create_from_png_stream(take, &reader));
  const cairo_status_t status = cairo_surface_status(surface.get());
  const cairo_format_t format =
      status == CAIRO_STATUS_SUCCESS ? cairo_image_surface_get_format(surface.get()) : CAIRO_FORMAT_INVALID;
  if (format != CAIRO_FORMAT_ARGB32 && format != CAIRO_FORMAT_RGB24) {
    return fail(ErrorCode::format,
                fmt::format("damaged PNG picture: {}",
                            status == CAIRO_STATUS_SUCCESS ? "unknown pixels" : cairo_status_to_string(status)),
                {file.string(), static_cast<std::int64_t>(reader.next)});
  }
  return image_of(surface.get());
}

}  // namespace sonar
