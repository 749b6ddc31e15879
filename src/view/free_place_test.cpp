// SPDX-License-Identifier: Apache-2.0
#include "view/free_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geo/geodesic.h"

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

// Law: where a box anywhere in the picture would be clear of a convex shape, a place is found, however narrow the room is; with
// a second box in the way it still is where the room is half a pixel wide.
TEST(FreePlace, WhereThereIsRoomAPlaceIsFound) {
  std::mt19937 random(11);
  const auto even = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  constexpr PixelRect kPicture{20, 10, 120, 80};
  int narrow = 0;
  for (int round = 0; round < 200; ++round) {
    const double turned = even(0.0, 3.0);
    std::vector<ConvexOutline> shapes(1);
    for (int i = 0; i < 5; ++i) {
      const double a = turned + 2.0 * std::numbers::pi * i / 5;
      shapes[0].push_back({even(70, 90) + 60 * std::cos(a), even(45, 55) + 40 * std::sin(a)});
    }
    std::vector<PlanePoint> corners;
    for (const PixelPoint& p : shapes[0]) corners.push_back({p.x, p.y});
    shapes[0].clear();
    for (const PlanePoint& p : convex_hull(corners)) shapes[0].push_back({p.x, p.y});
    if (round % 2 == 0) shapes.push_back(outline_of({even(20, 100), even(10, 70), 30, 15}));
    const PixelRect box{0, 0, even(10, 40), even(8, 30)};
    const auto clear = [&](PixelRect at, double spare) {
      at = {at.x - spare, at.y - spare, at.width + 2 * spare, at.height + 2 * spare};
      return std::ranges::none_of(shapes, [&](const ConvexOutline& shape) { return covers(at, shape); });
    };
    int rooms = 0;
    for (double x = kPicture.x; x <= kPicture.x + kPicture.width - box.width; x += 0.5) {
      for (double y = kPicture.y; y <= kPicture.y + kPicture.height - box.height; y += 0.5) {
        rooms += clear({x, y, box.width, box.height}, 0.0) ? 1 : 0;
      }
    }
    const auto found = free_place(kPicture, box.width, box.height, Corner::lower_right, shapes);
    narrow += rooms > 0 && rooms < 50 ? 1 : 0;
    if (rooms > 0) {
      EXPECT_TRUE(found) << round;
    }
    if (found) {
      EXPECT_TRUE(clear(*found, -1e-6)) << round;
    }
  }
  EXPECT_GT(narrow, 3);
}

TEST(FreePlace, TheCornerFirstThenAlongTheEdgesThenNone) {
  const PixelRect picture{0, 0, 240, 240};
  EXPECT_EQ(free_place(picture, 48, 24, Corner::lower_left, {}), (PixelRect{0, 216, 48, 24}));
  EXPECT_EQ(free_place(picture, 48, 24, Corner::lower_right, {}), (PixelRect{192, 216, 48, 24}));
  const ConvexOutline at_corner = outline_of({0, 200, 20, 40});
  const auto beside = free_place(picture, 48, 24, Corner::lower_left, std::span(&at_corner, 1));
  ASSERT_TRUE(beside);
  EXPECT_EQ(*beside, (PixelRect{20, 216, 48, 24})) << "as near as can be";
  const ConvexOutline all = outline_of({10, 10, 220, 220});
  EXPECT_FALSE(free_place(picture, 48, 24, Corner::lower_left, std::span(&all, 1)));
  EXPECT_FALSE(free_place(picture, 241, 24, Corner::lower_left, {}));
}

}  // namespace
}  // namespace sonar
