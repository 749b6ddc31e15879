// SPDX-License-Identifier: Apache-2.0
#include "render/cairo_values.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace sonar {
namespace {

std::uint32_t premultiplied(std::uint32_t channel, std::uint32_t alpha) { return (channel * alpha + 127U) / 255U; }

std::uint32_t word_of(Rgba8 c) {
  const std::uint32_t a = c.a;
  return a << 24U | premultiplied(c.r, a) << 16U | premultiplied(c.g, a) << 8U | premultiplied(c.b, a);
}

Rgba8 colour_of(std::uint32_t word, bool opaque) {
  const std::uint32_t a = opaque ? 255U : word >> 24U;
  if (a == 0U) return {0, 0, 0, 0};
  const auto straight = [a](std::uint32_t c) {
    return static_cast<std::uint8_t>(std::min<std::uint32_t>(255U, (c * 255U + a / 2U) / a));
  };
  return {straight((word >> 16U) & 255U), straight((word >> 8U) & 255U), straight(word & 255U),
          static_cast<std::uint8_t>(a)};
}

/// Red and blue change places: Rgba8 as a little-endian word, and Cairo's.
std::uint32_t swapped(std::uint32_t word) {
  return (word & 0xff00ff00U) | ((word >> 16U) & 0xffU) | ((word & 0xffU) << 16U);
}
constexpr bool kSwappable = std::endian::native == std::endian::little && sizeof(Rgba8) == sizeof(std::uint32_t);

/// Most rows hold nothing but clear and opaque pixels, which need no arithmetic.
void to_words(std::span<const Rgba8> row, std::span<std::uint32_t> words) {
  std::uint32_t between = kSwappable ? 0U : 1U;
  if (kSwappable) {
    std::memcpy(words.data(), row.data(), words.size_bytes());
    for (std::uint32_t& word : words) {
      const std::uint32_t alpha = word >> 24U;
      between |= (alpha + 1U) & 0xfeU;
      word = swapped(word) & (0U - (alpha >> 7U));
    }
  }
  if (between == 0U) return;
  for (std::size_t x = 0; x < row.size(); ++x) words[x] = word_of(row[x]);
}

void to_colours(std::span<std::uint32_t> words, bool opaque, std::span<Rgba8> row) {
  std::uint32_t all = opaque ? 0xff000000U : ~0U;
  if (!opaque) {
    for (const std::uint32_t word : words) all &= word;
  }
  if (!kSwappable || all >> 24U != 255U) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = colour_of(words[x], opaque);
    return;
  }
  for (std::uint32_t& word : words) word = swapped(word) | 0xff000000U;
  std::memcpy(static_cast<void*>(row.data()), words.data(), words.size_bytes());
}

}  // namespace

CairoSurface surface_of(const Image& image) {
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(), [](Rgba8 c) { return c.a == 255; });
  CairoSurface surface(cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, image.size.width,
                                                  image.size.height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  const std::span<const Rgba8> pixels(image.pixels);
  std::vector<std::uint32_t> words(static_cast<std::size_t>(image.size.width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.size.height); ++y) {
    to_words(pixels.subspan(y * words.size(), words.size()), words);
    std::memcpy(data + y * stride, words.data(), 4U * words.size());
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Image image_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const bool opaque = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_RGB24;
  Image image;
  image.size = {cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface)};
  image.pixels.reserve(image.size.count());
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  std::vector<std::uint32_t> words(static_cast<std::size_t>(image.size.width));
  std::vector<Rgba8> row(words.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.size.height); ++y) {
    std::memcpy(words.data(), data + y * stride, 4U * words.size());
    to_colours(words, opaque, row);
    image.pixels.insert(image.pixels.end(), row.begin(), row.end());
  }
  return image;
}

}  // namespace sonar
