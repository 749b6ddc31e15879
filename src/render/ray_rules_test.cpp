// SPDX-License-Identifier: Apache-2.0
#include "render/ray_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace sonar {
namespace {

/// Sixteen rays a pixel lie in sixteen places, about its middle.
TEST(RayRules, FramesTakeOtherPlacesInThePixel) {
  EXPECT_EQ(pixel_shift(0), (PixelPoint{0.0, 0.0}));
  PixelPoint mean;
  int quarter[4] = {};
  for (std::uint32_t n = 1; n <= 16; ++n) {
    const PixelPoint at = pixel_shift(n);
    ASSERT_LE(std::max(std::abs(at.x), std::abs(at.y)), 0.5);
    mean = {mean.x + at.x / 16.0, mean.y + at.y / 16.0};
    ++quarter[(at.x < 0.0 ? 0 : 1) + (at.y < 0.0 ? 0 : 2)];
  }
  EXPECT_LT(std::hypot(mean.x, mean.y), 0.05);
  for (const int count : quarter) EXPECT_NEAR(count, 4, 1);
}

/// So many frames are the rays of a picture four times as large; the next so many stand in the same parts, elsewhere.
TEST(RayRules, SixteenFramesAreTheRaysOfALargerPicture) {
  for (const std::uint32_t round : {0U, 1U, 5U}) {
    std::set<std::pair<int, int>> parts;
    for (std::uint32_t n = 1; n <= 16; ++n) {
      const PixelPoint at = pixel_shift(16 * round + n);
      const double x = 4.0 * (at.x + 0.5);
      const double y = 4.0 * (at.y + 0.5);
      parts.insert({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))});
      if (round > 0) continue;
      EXPECT_DOUBLE_EQ(x - std::floor(x), 0.5);
      EXPECT_DOUBLE_EQ(y - std::floor(y), 0.5);
    }
    EXPECT_EQ(parts.size(), 16U);
    for (const auto& [x, y] : parts) EXPECT_TRUE(x >= 0 && x < 4 && y >= 0 && y < 4);
  }
  EXPECT_NE(pixel_shift(1), pixel_shift(17));
}

/// Rays of equal share: their mean cosine is that of the cosine law, 2/3, and they lean to no side.
TEST(RayRules, AmbientLightComesFromAllOfTheHalfSpace) {
  double cosine = 0.0;
  double aside = 0.0;
  for (std::uint32_t n = 1; n <= 16; ++n) {
    for (const auto& ray : sky_rays(n)) {
      ASSERT_NEAR(std::hypot(ray[0], ray[1], ray[2]), 1.0, 1e-6);
      ASSERT_GE(ray[2], 0.0F);
      cosine += static_cast<double>(ray[2]) / (16.0 * kSkyRays);
      aside += static_cast<double>(ray[0] + ray[1]) / (16.0 * kSkyRays);
    }
  }
  EXPECT_NEAR(cosine, 2.0 / 3.0, 0.01);
  EXPECT_NEAR(aside, 0.0, 1e-6);
}

}  // namespace
}  // namespace sonar
