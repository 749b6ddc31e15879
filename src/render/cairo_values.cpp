// SPDX-License-Identifier: Apache-2.0
#include "render/cairo_values.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

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

}  // namespace

CairoSurface surface_of(const Image& image) {
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(), [](Rgba8 c) { return c.a == 255; });
  CairoSurface surface(cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, image.size.width,
                                                  image.size.height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::uint32_t word = word_of(image.at(x, y));
      std::memcpy(data + static_cast<std::size_t>(y) * stride + 4U * static_cast<std::size_t>(x), &word, 4U);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Image image_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const bool opaque = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_RGB24;
  Image image(PixelSize{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface)});
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + static_cast<std::size_t>(y) * stride + 4U * static_cast<std::size_t>(x), 4U);
      image.at(x, y) = colour_of(word, opaque);
    }
  }
  return image;
}

}  // namespace sonar
