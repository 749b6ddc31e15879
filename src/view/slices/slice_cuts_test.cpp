// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_cuts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/units.h"
#include "view/slices/slice_example.h"

namespace sonar {
namespace {

const PixelSize kSize{400, 300};

std::vector<Slice> slices_of(const Sector& sector) {
  const Voxel middle{sector.fans() / 2, sector.beams() / 2, sector.range().count / 2};
  const Point<Sonar> centre = sector.centre(middle.fan, middle.beam, middle.sample);
  return {TopSlice{middle.fan},
          SideSlice{middle.beam},
          RangeSlice{middle.sample},
          horizontal_plane(centre.z, 0.0),
          *vertical_plane({20.0, 5.0, 0.0}, centre),
          *oblique_plane(centre, {0.3, 0.4, -0.7})};
}

SliceMap map_of(const Sector& sector, const Slice& slice) {
  const SliceView view{slice};
  return {sector, view, *whole_extent(sector, view), kSize};
}

/// How far a place lies from a slice, m, told by the slice's own geometry alone.
double off_m(const Sector& sector, const Slice& slice, const Point<Sonar>& p) {
  const double range = norm(p);
  if (const auto* top = std::get_if<TopSlice>(&slice)) {
    return range * std::abs(std::asin(-p.z / range) - sector.elevation_rad(top->fan));
  }
  if (const auto* side = std::get_if<SideSlice>(&slice)) {
    const double turn = std::remainder(std::atan2(p.y, p.x) - sector.azimuth_rad(side->beam), 2.0 * std::acos(-1.0));
    return std::hypot(p.x, p.y) * std::abs(turn);
  }
  if (const auto* shell = std::get_if<RangeSlice>(&slice)) {
    return std::abs(range - sector.range().range_m(shell->sample));
  }
  const auto& plane = std::get<PlaneSlice>(slice);
  const Point<Sonar> d = p - plane.origin;
  const double right = d.x * plane.right.x + d.y * plane.right.y + d.z * plane.right.z;
  const double down = d.x * plane.down.x + d.y * plane.down.y + d.z * plane.down.z;
  return std::sqrt(std::max(0.0, norm(d) * norm(d) - right * right - down * down));
}

// Law: every place of a line lies in both slices and in the sector. Slices through one voxel meet.
TEST(SliceCut, LiesInBothSlices) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    const std::vector<Slice> slices = slices_of(sector);
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const SliceMap map = map_of(sector, slices[i]);
      const bool degrees = kind_of(slices[i]) == SliceKind::range;
      const double pixel = std::max((map.extent().x1 - map.extent().x0) / kSize.width,
                                    (map.extent().y1 - map.extent().y0) / kSize.height);
      const double reach_m = sector.range().range_m(sector.range().count);
      const double pixel_m = degrees ? rad_from_deg(pixel) * reach_m : pixel;
      for (std::size_t k = 0; k < slices.size(); ++k) {
        if (k == i) continue;
        std::size_t places = 0;
        for (const auto& line : slice_cut(map, slices[k])) {
          ASSERT_GE(line.size(), 2U);
          for (const PixelPoint& p : line) {
            const Point<Sonar> at = map.point_at(p);
            EXPECT_LT(off_m(sector, slices[k], at), 2.0 * pixel_m) << name << ": " << k << " in " << i;
            const SectorIndex index = sector.index_of(at * (1.0 - 1e-9));
            EXPECT_GT(index.sample, -1.0) << name;
            EXPECT_LT(index.sample, sector.range().count + 1.0) << name;
            ++places;
          }
        }
        // One fan's cone holds the horizontal line of the plane through the sonar and a place of it, and so on: they meet.
        EXPECT_GT(places, 0U) << name << ": " << k << " in " << i;
      }
    }
  }
}

// By hand: a fan's cone and a beam's half plane meet in a straight ray.
TEST(SliceCut, OfABeamInAFanIsOneStraightLine) {
  const Sector sector = slice_example::hand_sector();
  const auto lines = slice_cut(map_of(sector, TopSlice{4}), SideSlice{3});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 2U);
  // Beam 3 lies at azimuth 270: to port, which is left.
  EXPECT_NEAR(lines[0][0].y, lines[0][1].y, 1e-6);
}

// By hand: the plane through the sonar along a beam's azimuth is where that beam's slice lies.
TEST(SliceCut, OfASliceInTheSamePlaceIsNothing) {
  const Sector sector = slice_example::hand_sector();
  const Slice same = vertical_plane(sector.azimuth_rad(3));
  EXPECT_TRUE(slice_cut(map_of(sector, SideSlice{3}), same).empty());
  EXPECT_TRUE(slice_cut(map_of(sector, same), SideSlice{3}).empty());
  EXPECT_TRUE(slice_cut(map_of(sector, same), SideSlice{5}).empty()) << "they meet at the sonar alone";
}

// Law: what pixels show of a run is cut, and no pixel shows a run that is not.
TEST(FarthestCut, AgreesWithThePixels) {
  const PixelSize fine{1200, 900};
  int cut_runs = 0;
  for (const auto& [name, sector] : slice_example::sectors()) {
    for (const Slice& slice : slices_of(sector)) {
      const SliceView view{slice};
      const SliceMap map(sector, view, *whole_extent(sector, view), fine);
      const std::set<std::int32_t> shown(map.voxels().begin(), map.voxels().end());
      const int samples = sector.range().count;
      for (int row = 0; row < sector.fans() * sector.beams(); ++row) {
        for (int first = 3; first + 12 < samples; first += 12) {
          const sonar::Run run{row, first, 5};
          bool seen = false;
          for (int s = run.first_sample; s < run.end(); ++s) seen = seen || shown.contains(row * samples + s);
          const auto cut = farthest_cut(sector, slice, run);
          // The cells' faces are curved: a plane may touch a fan's cone between two corners.
          if (seen && std::holds_alternative<PlaneSlice>(slice) && !cut) {
            PingMask wider{{{row, std::max(0, first - 2), 9}}, {}};
            EXPECT_TRUE(cuts(sector, slice, wider)) << name;
            continue;
          }
          EXPECT_TRUE(cut || !seen) << name << " row " << row << " from " << first;
          if (!cut) continue;
          ++cut_runs;
          EXPECT_EQ(cut->fan * sector.beams() + cut->beam, row);
          EXPECT_GE(cut->sample, run.first_sample);
          EXPECT_LT(cut->sample, run.end());
        }
      }
    }
  }
  EXPECT_GT(cut_runs, 100);
}

// Law: a voxel of the slice stays where it is; another one comes to the foot of the square onto the plane.
TEST(Carried, StaysInTheSliceAndFallsSquareOntoAPlane) {
  const Sector sector = slice_example::hand_sector();
  const Voxel voxel{5, 2, 20};
  for (const Slice& slice : slices_of(sector)) {
    const SliceMap map = map_of(sector, slice);
    const auto carried = map.carried(voxel);
    ASSERT_TRUE(carried);
    if (const auto place = map.place_of(voxel)) {
      EXPECT_EQ(*carried, *place);
    }
    const Point<Sonar> at = map.point_at(*carried);
    EXPECT_LT(off_m(sector, slice, at), 1e-6);
    if (const auto* plane = std::get_if<PlaneSlice>(&slice)) {
      const Point<Sonar> d = sector.centre(voxel.fan, voxel.beam, voxel.sample) - at;
      if (!map.place_of(voxel)) {
        EXPECT_NEAR(d.x * plane->right.x + d.y * plane->right.y + d.z * plane->right.z, 0.0, 1e-6);
        EXPECT_NEAR(d.x * plane->down.x + d.y * plane->down.y + d.z * plane->down.z, 0.0, 1e-6);
      }
    }
  }
  EXPECT_FALSE(map_of(sector, TopSlice{4}).carried({4, 99, 20}));
}

TEST(SliceKinds, AreInTheVariantsOrder) {
  EXPECT_EQ(kind_of(TopSlice{}), SliceKind::top);
  EXPECT_EQ(kind_of(SideSlice{}), SliceKind::side);
  EXPECT_EQ(kind_of(RangeSlice{}), SliceKind::range);
  EXPECT_EQ(kind_of(PlaneSlice{}), SliceKind::plane);
  EXPECT_TRUE(seen_from_above(TopSlice{}) && seen_from_above(horizontal_plane(10.0, 0.0)));
  EXPECT_FALSE(seen_from_above(SideSlice{}) || seen_from_above(vertical_plane(0.3)) || seen_from_above(RangeSlice{}));
}

}  // namespace
}  // namespace sonar
