// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "view/slices/slice_example.h"

namespace sonar {
namespace {

using slice_example::hand_sector;

std::set<Voxel> voxels_of(const std::vector<Run>& runs, int beams) {
  std::set<Voxel> out;
  for (const sonar::Run& run : runs) {
    for (int s = run.first_sample; s < run.end(); ++s) out.insert({run.row / beams, run.row % beams, s});
  }
  return out;
}

TEST(Outline, WhatALineEnclosesTwiceIsOutside) {
  // A star of five points drawn in one stroke: its middle is enclosed twice.
  std::vector<PixelPoint> star;
  for (int i = 0; i < 5; ++i) {
    const double turn = 2.0 * std::numbers::pi * 2.0 * i / 5.0;
    star.push_back({std::sin(turn), -std::cos(turn)});
  }
  EXPECT_FALSE(within_outline(star, {0.0, 0.0}));
  EXPECT_TRUE(within_outline(star, {0.0, -0.7})) << "in a point of it";
  EXPECT_FALSE(within_outline(star, {0.0, 0.7})) << "between two points";
  EXPECT_FALSE(within_outline(star, {5.0, 0.0}));
}

TEST(Outline, ACornerOnTheLevelOfAPlaceCountsOnce) {
  const std::vector<PixelPoint> diamond{{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}};
  EXPECT_TRUE(within_outline(diamond, {0.0, 0.0}));
  EXPECT_FALSE(within_outline(diamond, {-2.0, 0.0}));
  EXPECT_FALSE(within_outline(diamond, {2.0, 0.0}));
  EXPECT_FALSE(within_outline({}, {0.0, 0.0}));
}

// x = starboard, y = against the bow; a centre lies at r cos e towards its azimuth.
TEST(SliceArea, ABoxFromAboveHoldsTheCentresOfItsFan) {
  const Sector sector = hand_sector();
  const std::vector<PixelPoint> box{{-121.3, -30.7}, {-40.3, -30.7}, {-40.3, 50.9}, {-121.3, 50.9}};
  for (const bool all : {false, true}) {
    std::set<Voxel> expected;
    for (int fan = 0; fan < 8; ++fan) {
      for (int beam = 0; beam < 7 && (all || fan == 5); ++beam) {
        for (int sample = 1; sample < 41; ++sample) {
          const double level = 5.0 * sample * std::cos(rad_from_deg(-70.0 + 10.0 * fan));
          const double x = level * std::sin(rad_from_deg(240.0 + 10.0 * beam));
          const double y = -level * std::cos(rad_from_deg(240.0 + 10.0 * beam));
          if (x > -121.3 && x < -40.3 && y > -30.7 && y < 50.9) expected.insert({fan, beam, sample});
        }
      }
    }
    ASSERT_GT(expected.size(), 20U);
    EXPECT_EQ(voxels_of(runs_within(sector, TopSlice{5}, box, all), 7), expected) << all;
  }
}

TEST(SliceArea, ABoxFromTheSideHoldsAllFansOfItsBeam) {
  const Sector sector = hand_sector();
  const std::vector<PixelPoint> box{{41.3, 10.7}, {119.1, 10.7}, {119.1, 90.3}, {41.3, 90.3}};
  std::set<Voxel> expected;
  for (int fan = 0; fan < 8; ++fan) {
    for (int sample = 1; sample < 41; ++sample) {
      const double down = rad_from_deg(70.0 - 10.0 * fan);
      const double x = 5.0 * sample * std::cos(down);
      const double y = 5.0 * sample * std::sin(down);
      if (x > 41.3 && x < 119.1 && y > 10.7 && y < 90.3) expected.insert({fan, 2, sample});
    }
  }
  ASSERT_GT(expected.size(), 20U);
  EXPECT_EQ(voxels_of(runs_within(sector, SideSlice{2}, box, true), 7), expected) << "all fans are in it anyway";
}

TEST(SliceArea, OfAPlaneItHoldsWhatThePictureShowsThere) {
  const Sector sector = hand_sector();
  const Point<Sonar> inside = sector.centre(4, 3, 20);
  for (const Slice& slice : {Slice(horizontal_plane(inside.z, 0.0)), Slice(*oblique_plane(inside, {0.3, 0.4, -0.8})),
                             Slice(RangeSlice{20})}) {
    const SliceView view{slice, 0.0, std::nullopt};
    const auto whole = whole_extent(sector, view);
    ASSERT_TRUE(whole);
    const SliceMap map(sector, view, *whole, {300, 240});
    const auto at = [&](double x, double y) { return map.slice_coordinates({x, y}); };
    const std::vector<PixelPoint> area{at(60, 40), at(230, 60), at(250, 200), at(80, 180)};
    const auto found = voxels_of(runs_within(sector, slice, area), 7);
    EXPECT_GT(found.size(), 3U) << slice.index();
    int shown = 0;
    int missed = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 300; ++x) {
        const auto voxel = map.voxel_at({x + 0.5, y + 0.5});
        if (!voxel) continue;
        const auto place = map.place_of(*voxel);
        ASSERT_TRUE(place);
        const PixelPoint p = map.slice_coordinates(*place);
        const bool within = within_outline(area, p);
        shown += within ? 1 : 0;
        // A plane that only grazes a cell has no place of its own in it: only the picture shows it.
        EXPECT_TRUE(within || !found.contains(*voxel));
        missed += within && !found.contains(*voxel) ? 1 : 0;
      }
    }
    EXPECT_GT(shown, 100);
    EXPECT_LT(missed, shown / 50) << "pixels of cells that are grazed";
  }
}

TEST(SliceArea, PlacesStayWhenAnotherDirectionComesUp) {
  const Sector sector = hand_sector();
  const double up = rad_from_deg(-35.0);
  for (const Slice& slice : {Slice(TopSlice{3}), Slice(horizontal_plane(60.0, 0.0)), Slice(SideSlice{2})}) {
    const SliceMap turned(sector, {slice, up, std::nullopt}, {-200, -200, 200, 200}, {100, 100});
    const SliceMap ship_up(sector, {slice, 0.0, std::nullopt}, {-200, -200, 200, 200}, {100, 100});
    const PixelPoint pixel{70.0, 20.0};
    const PixelPoint same = turned_up(slice, turned.slice_coordinates(pixel), up);
    const Point<Sonar> a = turned.point_at(pixel);
    const Point<Sonar> b = ship_up.point_at(ship_up.pixel_of(same.x, same.y));
    EXPECT_NEAR(norm(a - b), 0.0, 1e-9) << slice.index();
    const PixelPoint back = turned_up(slice, same, -up);
    EXPECT_NEAR(back.x, turned.slice_coordinates(pixel).x, 1e-9);
  }
}

}  // namespace
}  // namespace sonar
