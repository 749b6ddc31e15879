// SPDX-License-Identifier: Apache-2.0
#include "view/slices/plane_outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "view/slices/slice_example.h"

namespace sonar {
namespace {

const PixelSize kSize{400, 300};

SliceMap whole_map(const Sector& sector, const PlaneSlice& plane) {
  const SliceView view{plane};
  return {sector, view, *whole_extent(sector, view), kSize};
}

std::vector<PlaneSlice> planes() {
  return {horizontal_plane(40.0, 7.0), vertical_plane(rad_from_deg(268.0)),
          *oblique_plane({0.0, -60.0, 30.0}, {0.3, 0.4, -0.7})};
}

// Law: the distance is positive exactly in the sector's cells.
TEST(PlaneOutline, InsideIsWhereTheCellsAre) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    for (int i = 0; i < 4000; ++i) {
      const Point<Sonar> p{-210.0 + 420.0 * (i % 20) / 19.0, -210.0 + 420.0 * (i / 20 % 20) / 19.0,
                           -60.0 + 180.0 * (i / 400) / 9.0};
      const double by = inside_by_m(sector, p);
      if (std::abs(by) < 1e-6) continue;
      EXPECT_EQ(by > 0.0, sector.contains(sector.index_of(p))) << name << ' ' << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

// Law: along the line the map's pixels turn from cells to none: within two steps of the lattice it has both, but where
// the slice only touches.
TEST(PlaneOutline, RunsBetweenWhatIsThereAndWhatIsNot) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    for (const PlaneSlice& plane : planes()) {
      const SliceView view{plane};
      if (!whole_extent(sector, view)) continue;
      const SliceMap map = whole_map(sector, plane);
      int points = 0;
      int off = 0;
      for (const ContourLine& line : plane_outline(map)) {
        for (const PixelPoint& p : line.points) {
          bool in = false;
          bool out = false;
          for (const double x : {-4.0, 0.0, 4.0}) {
            for (const double y : {-4.0, 0.0, 4.0}) {
              const bool there = map.voxel_at({p.x + x, p.y + y}).has_value();
              in = in || there;
              out = out || !there;
            }
          }
          ++points;
          off += in && out ? 0 : 1;
        }
      }
      EXPECT_GT(points, 100) << name;
      EXPECT_LE(off, points / 50) << name;
    }
  }
}

TEST(PlaneOutline, IsDrawnWithThePlane) {
  const Sector sector = slice_example::hand_sector();
  const slice_example::LitVolume volume(sector, {4, 3, 20}, -30.0, -90.0);
  const PixelSize size{640, 480};
  const Theme theme = light_theme(size);
  for (const PlaneSlice& plane : planes()) {
    for (const bool rings : {true, false}) {
      SliceStyle style;
      style.rings = rings;
      const auto picture = slice_picture(sector, volume.data(), {}, {plane}, style, theme, size);
      ASSERT_TRUE(picture.has_value());
      bool drawn = false;
      for (const auto& item : picture->frame.items) {
        if (const auto* path = std::get_if<PathItem>(&item)) {
          drawn = drawn || (path->stroke.colour == theme.outline && path->stroke.dashes_px.empty());
        }
      }
      EXPECT_EQ(drawn, rings);
    }
  }
}

}  // namespace
}  // namespace sonar
