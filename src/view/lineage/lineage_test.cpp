// SPDX-License-Identifier: Apache-2.0
#include "view/lineage/lineage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <variant>
#include <vector>

namespace sonar {
namespace {

constexpr PixelSize kSize{800, 400};
constexpr TimeNs kBegin = 1'600'000'000 * kSecondNs;

LineageSchool school(std::int64_t id, std::int64_t first, std::int64_t last) {
  LineageSchool made{id, "unreviewed", std::vector<std::int64_t>(static_cast<std::size_t>(last - first + 1))};
  std::iota(made.pings.begin(), made.pings.end(), first);
  return made;
}

/// Ten pings a second apart. 1 is there all the time, lost in pings 3 and 4; 2 comes next and has nothing to do with anyone;
/// 3 splits from 1 in ping 6; 4 merges into 1 after ping 5.
LineageData family() {
  LineageData data;
  data.title = "obs-0001";
  for (int i = 0; i < 10; ++i) data.times.push_back(kBegin + i * kSecondNs);
  data.schools = {school(1, 0, 9), school(2, 1, 9), school(3, 6, 9), school(4, 2, 5)};
  std::erase_if(data.schools[0].pings, [](std::int64_t ping) { return ping == 3 || ping == 4; });
  data.edges = {{1, TrackEdgeKind::born, 0, 0},  {1, TrackEdgeKind::lost, 2, 0},  {1, TrackEdgeKind::refound, 5, 0},
                {2, TrackEdgeKind::born, 1, 0},  {3, TrackEdgeKind::split, 6, 1}, {4, TrackEdgeKind::born, 2, 0},
                {4, TrackEdgeKind::merged, 5, 1}};
  return data;
}

/// Upright lines from one place to another.
int upright(const Lineage& drawn, PixelPoint from, PixelPoint to) {
  return static_cast<int>(std::ranges::count_if(drawn.frame.items, [&](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->parts.size() != 1 || path->parts[0].points.size() != 2) return false;
    const auto near = [](PixelPoint a, PixelPoint b) {
      return std::abs(a.x - b.x) < 0.01 && std::abs(a.y - b.y) < 0.01;
    };
    const auto& points = path->parts[0].points;
    return (near(points[0], from) && near(points[1], to)) || (near(points[0], to) && near(points[1], from));
  }));
}

TEST(Lineage, RelativesLieNextToEachOther) { EXPECT_EQ(lane_order(family()), (std::vector<std::int64_t>{1, 4, 3, 2})); }

TEST(Lineage, SchoolsThatWentIntoEachOtherHaveALaneEach) {
  LineageData data = family();
  data.edges = {{2, TrackEdgeKind::merged, 4, 3}, {3, TrackEdgeKind::split, 6, 2}};
  auto order = lane_order(data);
  std::ranges::sort(order);
  EXPECT_EQ(order, (std::vector<std::int64_t>{1, 2, 3, 4}));
}

TEST(Lineage, SplitsAndMergesAreLinesBetweenTheirLanesAtTheirPings) {
  const LineageData data = family();
  const auto drawn = lineage(data, {}, kSize, light_theme(kSize));
  ASSERT_TRUE(drawn) << drawn.error().text;
  EXPECT_EQ(drawn->lanes, (std::vector<std::int64_t>{1, 4, 3, 2}));
  const auto at = [&](double second, double lane) { return drawn->plot.at(second, lane + 0.5); };
  EXPECT_EQ(upright(*drawn, at(6.0, 0.0), at(6.0, 2.0)), 1) << "3 splits from 1 where its first ping begins";
  EXPECT_EQ(upright(*drawn, at(6.0, 0.0), at(6.0, 1.0)), 1) << "4 goes into 1 where its last ping, 5, ends";
  EXPECT_EQ(upright(*drawn, at(3.0, 0.0), at(5.0, 0.0)), 1) << "1 is not seen from the end of ping 2 to ping 5";
  EXPECT_EQ(upright(*drawn, at(6.0, 0.0), at(6.0, 3.0)), 0) << "2 has nothing to do with anyone";
}

TEST(Lineage, OnlySchoolsOfTheShownTimeHaveLanes) {
  LineageStyle style;
  style.shown = TimelineInterval{kBegin, kBegin + kSecondNs};
  style.free_lane = true;
  const auto drawn = lineage(family(), style, kSize, light_theme(kSize));
  ASSERT_TRUE(drawn);
  EXPECT_EQ(drawn->lanes, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(drawn->plot.y.last, 3.0) << "and a free one below";
  EXPECT_EQ(drawn->all.last, kBegin + 10 * kSecondNs) << "the last ping takes its own room";
}

TEST(Lineage, TheSelectedSchoolIsFramedAndNoOther) {
  LineageData data = family();
  const Theme theme = light_theme(kSize);
  const auto framed = [&] {
    const auto drawn = lineage(data, {}, kSize, theme);
    std::vector<PixelRect> at;
    for (const auto& item : drawn->frame.items) {
      const auto* path = std::get_if<PathItem>(&item);
      if (path == nullptr || path->stroke.colour != theme.accent || path->stroke.width_px == 0.0) continue;
      EXPECT_NEAR(0.5 * (path->parts[0].points[0].y + path->parts[0].points[2].y), drawn->plot.at(0.0, 2.5).y, 0.01);
      at.emplace_back();
    }
    return at.size();
  };
  EXPECT_EQ(framed(), 0U);
  data.selected = 3;
  EXPECT_EQ(framed(), 1U);
}

TEST(Lineage, WhatCannotBeDrawnIsTold) {
  const Theme theme = light_theme(kSize);
  EXPECT_EQ(lineage(family(), {}, {50, 50}, theme).error().code, ErrorCode::bad_parameter);
  LineageData data = family();
  data.schools.clear();
  EXPECT_EQ(lineage(data, {}, kSize, theme).error().code, ErrorCode::not_found);
  EXPECT_EQ(lineage({}, {}, kSize, theme).error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace sonar
