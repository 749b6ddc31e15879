// SPDX-License-Identifier: Apache-2.0
#include "view/volume/current_arrows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/navigation.h"
#include "view/slices/slice_example.h"
#include "view/theme.h"
#include "view/volume/context_scene.h"
#include "view/volume/earth_pose.h"

namespace sonar {
namespace {

constexpr double kTransducer_m = 7.0;
constexpr PixelSize kSize{640, 480};

/// North at 20 m, half as fast to the east at 60 m, no direction at 100 m.
CurrentColumn two_layers() { return {{{20.0, 0.0, 0.4}, {60.0, 0.2, 0.0}, {100.0, 0.001, 0.0}}, 0.4}; }

std::vector<CurrentArrow> at_heading(double heading_deg) {
  return current_arrows(slice_example::hand_sector(), two_layers(), heading_deg, kTransducer_m);
}

void expect_way(const CurrentArrow& arrow, double ahead_m, double to_starboard_m) {
  EXPECT_NEAR(arrow.to.x - arrow.from.x, ahead_m, 1e-9);
  EXPECT_NEAR(arrow.to.y - arrow.from.y, to_starboard_m, 1e-9);
  EXPECT_EQ(arrow.to.z, arrow.from.z) << "level";
}

// By hand: of a range of 200 m a quarter is 50 m, over 0.4 m/s 125, so 100 m for 1 m/s: 40 m and 20 m. A ship that heads
// north has north ahead and east to starboard; one that heads east has north to port and east ahead; one that heads 210
// has north at cos 210 = -0.866 ahead, -sin 210 = 0.5 to starboard.
TEST(CurrentArrows, PointWhereTheWaterGoesSeenFromTheShip) {
  const auto north = at_heading(0.0);
  ASSERT_EQ(north.size(), 2U) << "still water has no direction";
  expect_way(north[0], 40.0, 0.0);
  expect_way(north[1], 0.0, 20.0);
  EXPECT_NEAR(north[0].from.z, 13.0, 1e-12) << "20 m below the sea is 13 m below the transducer";
  EXPECT_EQ(std::hypot(north[1].from.x, north[1].from.y), 0.0) << "straight below the ship";
  const auto east = at_heading(90.0);
  expect_way(east[0], 0.0, -40.0);
  expect_way(east[1], 20.0, 0.0);
  const auto back = at_heading(210.0);
  expect_way(back[0], -40.0 * std::sqrt(0.75), 20.0);
}

TEST(CurrentArrows, NoneWithoutAHeadingOrWhereNothingIsTold) {
  const Sector sector = slice_example::hand_sector();
  EXPECT_TRUE(current_arrows(sector, two_layers(), std::nullopt, kTransducer_m).empty());
  EXPECT_EQ(current_words(sector, two_layers(), std::nullopt), "");
  CurrentColumn column = two_layers();
  column.at.erase(column.at.begin());
  const auto left = current_arrows(sector, column, 0.0, kTransducer_m);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].depth_m, 60.0);
  expect_way(left[0], 0.0, 20.0);
  column.at.clear();
  EXPECT_EQ(current_words(sector, column, 0.0), "");
}

TEST(CurrentArrows, TheLegendTellsTheScaleThatTheyAreDrawnTo) {
  const Sector sector = slice_example::hand_sector();
  EXPECT_EQ(current_words(sector, two_layers(), 0.0), "current below the ship: 0.2 m/s is 20 m long");
  for (double fastest_mps = 0.01; fastest_mps < 5.0; fastest_mps *= 1.07) {
    const CurrentColumn column{{{20.0, fastest_mps, 0.0}}, fastest_mps};
    const auto scale = current_scale(sector, column);
    ASSERT_TRUE(scale);
    const double longest_m = fastest_mps / scale->speed_mps * scale->length_m;
    EXPECT_LE(longest_m, 50.0 * (1.0 + 1e-6));
    EXPECT_GT(longest_m, 50.0 / 2.6) << "nor much shorter";
    const auto arrows = current_arrows(sector, column, 0.0, 0.0);
    EXPECT_NEAR(norm(arrows.at(0).to - arrows[0].from), longest_m, 1e-9);
  }
}

// Nine of ten speeds are 0.1 to 0.3 m/s, so that 0.3 is what nine tenths keep below, half as much again 0.45: a wild 6 m/s is
// no reason to draw them twenty times shorter. Of nine none is called wild. Speeds whose two components vary normally
// (Rayleigh): nine tenths lie below sqrt(2 ln 10) of a component's deviation, and above 1.5 times that 10^-2.25 = 1 in 178.
TEST(CurrentArrows, OneWildBinDoesNotShrinkTheOthers) {
  EXPECT_NEAR(longest_arrow_mps({0.3, 0.1, 6.0, 0.3, 0.2, 0.1, 0.3, 0.2, 0.1, 0.3}), 0.45, 1e-12);
  EXPECT_EQ(longest_arrow_mps({0.3, 0.1, 6.0, 0.3, 0.2, 0.1, 0.3, 0.2, 0.1}), 6.0);
  EXPECT_EQ(longest_arrow_mps({0.3, 0.1, 0.4, 0.3, 0.2, 0.1, 0.3, 0.2, 0.1, 0.3}), 0.4) << "none is wild";
  EXPECT_EQ(longest_arrow_mps({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3}), 0.3);
  EXPECT_EQ(longest_arrow_mps({}), 0.0);
  std::vector<double> rayleigh;
  for (int i = 0; i < 10'000; ++i) rayleigh.push_back(std::sqrt(-2.0 * std::log((i + 0.5) / 10'000.0)));
  const double longest = longest_arrow_mps(rayleigh);
  EXPECT_EQ(std::count_if(rayleigh.begin(), rayleigh.end(), [&](double speed) { return speed > longest; }), 56);
}

// A quarter of 200 m over 0.4 m/s, down to a round one: 100 m for 1 m/s, 40 m for 0.4. At 6 m/s it is as long, with a second
// head of four strokes, and the legend says so.
TEST(CurrentArrows, FasterThanTheLongestIsCutAndTold) {
  const Sector sector = slice_example::hand_sector();
  CurrentColumn column = two_layers();
  const auto strokes = [&] {
    ContextScene scene;
    add_current_arrows(scene, current_arrows(sector, column, 0.0, kTransducer_m), kTransducer_m, light_theme(kSize));
    return scene.lines.size();
  };
  const std::size_t before = strokes();
  column.at[0].north_mps = 6.0;
  const auto arrows = current_arrows(sector, column, 0.0, kTransducer_m);
  ASSERT_EQ(arrows.size(), 2U);
  expect_way(arrows[0], 40.0, 0.0);
  EXPECT_TRUE(arrows[0].cut);
  expect_way(arrows[1], 0.0, 20.0);
  EXPECT_FALSE(arrows[1].cut);
  EXPECT_EQ(strokes(), before + 4);
  EXPECT_EQ(current_words(sector, column, 0.0),
            "current below the ship: 0.2 m/s is 20 m long; two heads: above 0.40 m/s");
}

// Deepest is the fan at -70 degrees: 200 sin 70 + 7 = 194.9 m.
TEST(CurrentArrows, StandAtEvenDepthsDownToTheDeepestPlace) {
  EXPECT_EQ(current_depths(slice_example::hand_sector(), kTransducer_m),
            (std::vector<double>{20, 40, 60, 80, 100, 120, 140, 160, 180}));
}

// 0.4 m/s are 0.78 kn, so 0.5 kn = 0.2572 m/s are told; 100 m for 1 m/s make that 25.72 m = 84.4 ft. Down to 194.9 m =
// 639 ft every 50 ft are twelve arrows.
TEST(CurrentArrows, AreReadInTheChosenUnits) {
  const Units units{LengthUnit::feet, SpeedUnit::knots};
  const Sector sector = slice_example::hand_sector();
  EXPECT_EQ(current_words(sector, two_layers(), 0.0, units), "current below the ship: 0.5 kn is 84.4 ft long");
  const auto depths_m = current_depths(sector, kTransducer_m, units);
  ASSERT_EQ(depths_m.size(), 12U);
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    EXPECT_NEAR(depths_m[i], 0.3048 * 50.0 * static_cast<double>(i + 1), 1e-9);
  }
}

// Law: a ship turns from 20 to 110 degrees on the spot. Before an eye that stands still on the earth arrows stay where
// they are; before one that turns with the ship they turn.
TEST(CurrentArrows, TurnInTheShipsViewAndStandInThatOfTheEarth) {
  PingNavigation then;
  then.transducer = {60.0, 5.0};
  then.heading_deg = 20.0;
  then.transducer_depth_m = kTransducer_m;
  PingNavigation now = then;
  now.heading_deg = 110.0;
  const Camera eye{{300.0, -400.0, -200.0}, {0.0, 0.0, 50.0}, {0.0, 0.0, -1.0}, 0.6};
  const auto standing = standing_still(eye, then, now);
  ASSERT_TRUE(standing);
  const auto tip = [](const Camera& camera, double heading_deg) {
    const auto seen = basis(camera, kSize).project(at_heading(heading_deg).at(0).to);
    return seen ? seen->pixel : PixelPoint{-1e9, -1e9};
  };
  const PixelPoint before = tip(eye, 20.0);
  const PixelPoint earth = tip(*standing, 110.0);
  const PixelPoint ship = tip(eye, 110.0);
  EXPECT_NEAR(earth.x, before.x, 1e-6);
  EXPECT_NEAR(earth.y, before.y, 1e-6);
  EXPECT_GT(std::hypot(ship.x - before.x, ship.y - before.y), 20.0);
}

// Each line of the scene that is not upright lies at an arrow; the deepest line ends at the deepest arrow.
TEST(CurrentArrows, AreDrawnRoundTheVolumeAndLabelled) {
  const Sector sector = slice_example::hand_sector();
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = false;
  params.currents = two_layers();
  EXPECT_TRUE(context_scene(sector, params, light_theme(kSize)).lines.empty()) << "no heading, no arrows";
  params.heading_deg = 90.0;
  const auto lines = context_scene(sector, params, light_theme(kSize)).lines;
  const auto reached = [&](const Point<Sonar>& place) {
    return std::any_of(lines.begin(), lines.end(), [&](const SceneLine& line) { return norm(line.to - place) < 1e-9; });
  };
  EXPECT_TRUE(reached({0.0, -40.0, 13.0}));
  EXPECT_TRUE(reached({20.0, 0.0, 53.0}));
  EXPECT_FALSE(reached({0.0, 0.0, 93.0}));
  FrameDescription frame{kSize, {}, {}, {}};
  add_context_labels(frame, sector, params, basis(overview(sector, kSize), kSize), light_theme(kSize));
  std::vector<std::string> words;
  for (const auto& item : frame.items) words.push_back(std::get<TextItem>(item).text);
  EXPECT_EQ(words, (std::vector<std::string>{"20 m", "60 m"}));
  params.units.lengths = LengthUnit::feet;
  FrameDescription in_feet{kSize, {}, {}, {}};
  add_context_labels(in_feet, sector, params, basis(overview(sector, kSize), kSize), light_theme(kSize));
  ASSERT_FALSE(in_feet.items.empty());
  for (const auto& item : in_feet.items) EXPECT_TRUE(std::get<TextItem>(item).text.ends_with(" ft"));
}

}  // namespace
}  // namespace sonar
