// SPDX-License-Identifier: Apache-2.0
#include "view/free_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace sonar {
namespace {

// A diamond about (50, 50) reaching 40 to each side: the square of its box is covered in the middle and free at a corner.
TEST(FreePlace, AShapeCoversNoMoreThanItself) {
  const ConvexOutline diamond{{90, 50}, {50, 90}, {10, 50}, {50, 10}};
  EXPECT_TRUE(covers({45, 45, 10, 10}, diamond));
  EXPECT_TRUE(covers({0, 0, 100, 100}, diamond));
  EXPECT_FALSE(covers({10, 10, 19, 19}, diamond)) << "its corner (29, 29) lies beyond x + y = 60";
  EXPECT_TRUE(covers({10, 10, 21, 21}, diamond));
  EXPECT_FALSE(covers({91, 40, 20, 20}, diamond));
  EXPECT_FALSE(covers({0, 0, 10, 10}, {}));
}

// Law: a place that is found covers no point of a shape, and is found wherever the corner that is asked for is clear.
TEST(FreePlace, NoPointOfAShapeLiesInThePlace) {
  std::mt19937 random(7);
  const auto even = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const PixelRect picture{20, 10, 300, 200};
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    const double middle_x = even(20, 320);
    const double middle_y = even(10, 210);
    const double reach = even(5, 110);
    const double high = even(5, 90);
    ConvexOutline ellipse;
    for (int i = 0; i < 40; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 40;
      ellipse.push_back({middle_x + reach * std::cos(a), middle_y + high * std::sin(a)});
    }
    const auto place =
        free_place(picture, 120, 60, round % 2 == 0 ? Corner::lower_left : Corner::lower_right, std::span(&ellipse, 1));
    if (!place) continue;
    ++found;
    EXPECT_GE(place->x, picture.x);
    EXPECT_GE(place->y, picture.y);
    EXPECT_LE(place->x + place->width, picture.x + picture.width + 1e-9);
    EXPECT_LE(place->y + place->height, picture.y + picture.height + 1e-9);
    for (const PixelPoint& p : ellipse) {
      for (const double in : {0.0, 0.3, 0.6, 0.9}) {
        const PixelPoint within{middle_x + in * (p.x - middle_x), middle_y + in * (p.y - middle_y)};
        const bool inner = within.x > place->x && within.y > place->y && within.x < place->x + place->width &&
                           within.y < place->y + place->height;
        EXPECT_FALSE(inner) << round;
      }
    }
  }
  EXPECT_GT(found, 150);
}

TEST(FreePlace, TheCornerFirstThenAlongTheEdgesThenNone) {
  const PixelRect picture{0, 0, 240, 240};
  EXPECT_EQ(free_place(picture, 48, 24, Corner::lower_left, {}), (PixelRect{0, 216, 48, 24}));
  EXPECT_EQ(free_place(picture, 48, 24, Corner::lower_right, {}), (PixelRect{192, 216, 48, 24}));
  const ConvexOutline at_corner = outline_of({0, 200, 20, 40});
  const auto beside = free_place(picture, 48, 24, Corner::lower_left, std::span(&at_corner, 1));
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->y, 216.0);
  EXPECT_NEAR(beside->x, 24.0, 4.0) << "as near as steps of 8 pixels allow";
  const ConvexOutline all = outline_of({10, 10, 220, 220});
  EXPECT_FALSE(free_place(picture, 48, 24, Corner::lower_left, std::span(&all, 1)));
  EXPECT_FALSE(free_place(picture, 241, 24, Corner::lower_left, {}));
}

}  // namespace
}  // namespace sonar
