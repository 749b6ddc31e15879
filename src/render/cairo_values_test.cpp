// SPDX-License-Identifier: Apache-2.0
#include "render/cairo_values.h"

#include <gtest/gtest.h>

#include <cstring>

namespace sonar {
namespace {

std::uint32_t word_at(cairo_surface_t* surface, int x, int y) {
  std::uint32_t word = 0;
  std::memcpy(&word, cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x, 4);
  return word;
}

/// A row of clear and opaque pixels, an opaque one and one with everything between.
Image rows() {
  Image image({4, 3});
  image.pixels = {{0, 0, 0, 0},      {10, 20, 30, 255}, {255, 255, 255, 0}, {250, 1, 2, 255},
                  {1, 2, 3, 255},    {40, 50, 60, 255}, {0, 0, 0, 255},     {255, 255, 255, 255},
                  {10, 20, 30, 255}, {200, 100, 40, 1}, {200, 100, 40, 51}, {200, 100, 40, 254}};
  return image;
}

// Premultiplied by hand: c a / 255, rounded.
TEST(CairoValues, PixelsBecomePremultipliedWords) {
  const CairoSurface surface = surface_of(rows());
  EXPECT_EQ(word_at(surface.get(), 0, 0), 0x00000000U);
  EXPECT_EQ(word_at(surface.get(), 1, 0), 0xff0a141eU);
  EXPECT_EQ(word_at(surface.get(), 2, 0), 0x00000000U);
  EXPECT_EQ(word_at(surface.get(), 3, 0), 0xfffa0102U);
  EXPECT_EQ(word_at(surface.get(), 1, 1), 0xff28323cU);
  EXPECT_EQ(word_at(surface.get(), 0, 2), 0xff0a141eU);
  EXPECT_EQ(word_at(surface.get(), 1, 2), 0x01010000U);
  EXPECT_EQ(word_at(surface.get(), 2, 2), 0x33281408U);
  EXPECT_EQ(word_at(surface.get(), 3, 2), 0xfec76428U);
}

TEST(CairoValues, OpaquePixelsComeBackAsTheyWere) {
  const Image before = rows();
  const Image after = image_of(surface_of(before).get());
  ASSERT_EQ(after.size, before.size);
  for (std::size_t i = 0; i < before.pixels.size(); ++i) {
    if (before.pixels[i].a == 255) {
      EXPECT_EQ(after.pixels[i], before.pixels[i]) << i;
    }
  }
  EXPECT_EQ(after.pixels[0], (Rgba8{0, 0, 0, 0}));
  EXPECT_EQ(after.pixels[2], (Rgba8{0, 0, 0, 0}));
  EXPECT_EQ(after.pixels[10], (Rgba8{200, 100, 40, 51}));
  Image opaque({4, 1});
  opaque.pixels = {before.pixels.begin() + 4, before.pixels.begin() + 8};
  EXPECT_EQ(image_of(surface_of(opaque).get()), opaque);
}

}  // namespace
}  // namespace sonar
