// SPDX-License-Identifier: Apache-2.0
#include "view/label_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sonar {
namespace {

constexpr PixelRect kInside{0.0, 0.0, 200.0, 100.0};

TextItem label_at(PixelPoint at) {
  TextItem label;
  label.at = at;
  label.text = "17";
  label.size_px = 10.0;
  label.anchor = TextAnchor::centre;
  return label;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

bool lies_in(const PixelRect& box, const PixelRect& in) {
  return box.x >= in.x && box.y >= in.y && box.x + box.width <= in.x + in.width &&
         box.y + box.height <= in.y + in.height;
}

TEST(PlaceNearest, IsTheAnchorWhereThatIsFree) {
  LabelRoom room(kInside);
  const auto placed = room.place_nearest(label_at({100.0, 50.0}));
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->at, (PixelPoint{100.0, 50.0}));
}

TEST(PlaceNearest, FindsTheOneGapThatIsLeft) {
  const PixelRect box = LabelRoom::box_of(label_at({0.0, 0.0}));
  LabelRoom room(kInside);
  room.take({0.0, 0.0, 150.0, 100.0});
  room.take({150.0, 0.0, 50.0, 30.0});
  room.take({150.0, 30.0 + box.height + 0.01, 50.0, 100.0});
  const auto placed = room.place_nearest(label_at({20.0, 90.0}));
  ASSERT_TRUE(placed);
  EXPECT_NEAR(LabelRoom::box_of(*placed).x, 150.0, 0.01);
  const auto next = room.place_nearest(label_at({20.0, 90.0}));
  EXPECT_FALSE(next && overlap(LabelRoom::box_of(*next), LabelRoom::box_of(*placed))) << "its room is taken";
}

TEST(PlaceNearest, IsNowhereWhereAllIsTaken) {
  LabelRoom room(kInside);
  room.take(kInside);
  EXPECT_FALSE(room.place_nearest(label_at({100.0, 50.0})));
}

// Law: no place of a fine grid is free and nearer.
TEST(PlaceNearest, NoFreePlaceIsNearer) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int scene = 0; scene < 50; ++scene) {
    LabelRoom room(kInside);
    std::vector<PixelRect> taken;
    for (int i = 0; i < 12; ++i) {
      taken.push_back(
          {180.0 * part(random), 80.0 * part(random), 10.0 + 60.0 * part(random), 8.0 + 30.0 * part(random)});
      room.take(taken.back());
    }
    const TextItem label = label_at({200.0 * part(random), 100.0 * part(random)});
    const auto free = [&](const TextItem& there) {
      const PixelRect box = LabelRoom::box_of(there);
      return lies_in(box, kInside) && std::ranges::none_of(taken, [&](const auto& t) { return overlap(t, box); });
    };
    const auto away = [&](PixelPoint at) { return std::hypot(at.x - label.at.x, at.y - label.at.y); };
    const auto placed = room.place_nearest(label);
    if (placed) {
      EXPECT_TRUE(free(*placed)) << scene;
    }
    for (double x = 0.0; x <= 200.0; x += 1.0) {
      for (double y = 0.0; y <= 100.0; y += 1.0) {
        if (!free(label_at({x, y}))) continue;
        ASSERT_TRUE(placed) << scene;
        ASSERT_GE(away({x, y}), away(placed->at) - 1e-3) << scene;
      }
    }
  }
}

}  // namespace
}  // namespace sonar
