// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_voxels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "view/slices/slice_example.h"
#include "view/slices/slice_geometry.h"

namespace sonar {
namespace {

using slice_example::even_deg;
using slice_example::Named;
using slice_example::radians;

/// Every pixel by itself, as slow as it gets.
std::vector<std::int32_t> one_by_one(const Sector& sector, const SliceView& view, const SliceExtent& e,
                                     PixelSize size) {
  const SliceGeometry geometry(sector, view);
  std::vector<std::int32_t> out;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto v =
          geometry.voxel(e.x0 + (x + 0.5) * (e.x1 - e.x0) / size.width, e.y0 + (y + 0.5) * (e.y1 - e.y0) / size.height);
      out.push_back(v ? (v->fan * sector.beams() + v->beam) * sector.range().count + v->sample : -1);
    }
  }
  return out;
}

/// Beside the grids as they come: wider than half a turn, all round with a seam, more than a turn, over the zenith.
std::vector<Named> grids() {
  std::vector<Named> out = slice_example::sectors();
  const RangeAxis range{-1.0, 2.0, 101};
  out.push_back({"half a turn", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(185, 10, 18)), range)});
  out.push_back({"three quarters", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(95, 10, 27)), range)});
  out.push_back({"a gap of 2 degrees", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(1, 2, 179)), range)});
  out.push_back({"more than a turn", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(0, 10, 40)), range)});
  out.push_back({"two beams", Sector(radians(even_deg(-40, 20, 2)), radians(even_deg(0, 175, 2)), range)});
  out.push_back({"over the zenith", Sector(radians(even_deg(-92, 8, 24)), radians(even_deg(240, 5, 8)), range)});
  out.push_back({"to the nadir", Sector(radians(even_deg(-87, 6, 15)), radians(even_deg(240, 5, 8)), range)});
  return out;
}

std::vector<SliceView> views(const Sector& sector) {
  const int fan = sector.fans() / 2;
  const int beam = sector.beams() / 2;
  const Point<Sonar> inside = sector.centre(fan, beam, 60);
  const double turn = 2.0 * std::numbers::pi;
  return {{TopSlice{fan}},
          {TopSlice{0}, rad_from_deg(-35.0)},
          {TopSlice{fan}, rad_from_deg(90.0) + 3.0 * turn},
          {TopSlice{fan}, 1e6},
          {SideSlice{beam}},
          {RangeSlice{60}},
          {horizontal_plane(inside.z, 0.0)},
          {horizontal_plane(0.0, 0.0)},
          {horizontal_plane(inside.z, 0.0), rad_from_deg(120.0)},
          {vertical_plane(sector.azimuth_rad(beam))},
          {*oblique_plane(inside, {0.3, 0.4, -0.7})}};
}

TEST(SliceVoxels, AreThoseOfEveryPixelByItself) {
  // The middles of the middle row and column lie on x = 0 and y = 0, where borders of the cells do.
  const PixelSize size{161, 121};
  for (const auto& [name, sector] : grids()) {
    for (const SliceView& view : views(sector)) {
      const bool degrees = std::holds_alternative<RangeSlice>(view.slice);
      const SliceExtent whole = degrees ? SliceExtent{-20, -95, 400, 95} : SliceExtent{-210, -205, 210, 205};
      for (const double zoom : {1.0, 0.02}) {
        const SliceExtent e{whole.x0 * zoom, whole.y0 * zoom, whole.x1 * zoom, whole.y1 * zoom};
        ASSERT_EQ(slice_voxels(sector, view, e, size), one_by_one(sector, view, e, size))
            << name << " slice " << view.slice.index() << " zoom " << zoom;
      }
    }
  }
}

// Pixels a few roundings apart, round a corner where four cells meet.
TEST(SliceVoxels, AreExactAtTheCornersOfCells) {
  for (const auto& [name, sector] : grids()) {
    const int beam = sector.beams() / 2;
    const int fan = sector.fans() / 2;
    const double r = sector.range().range_m(50.5);
    const double azimuth = sector.azimuth_bounds(beam).lower;
    const double elevation = sector.elevation_bounds(fan).lower;
    const double horizontal = r * std::cos(sector.elevation_rad(fan));
    const Point<Sonar> corner = Sector::direction(elevation, azimuth) * r;
    const std::vector<std::pair<SliceView, PixelPoint>> places = {
        {{TopSlice{fan}}, {horizontal * std::sin(azimuth), -horizontal * std::cos(azimuth)}},
        {{SideSlice{beam}}, {r * std::cos(elevation), -r * std::sin(elevation)}},
        {{horizontal_plane(corner.z, 0.0)}, {corner.y, -corner.x}}};
    for (const auto& [view, at] : places) {
      for (const double half : {1e-13, 1e-9, 1e-7, 1e-5}) {
        const SliceExtent e{at.x - half, at.y - half, at.x + half, at.y + half};
        ASSERT_EQ(slice_voxels(sector, view, e, {21, 21}), one_by_one(sector, view, e, {21, 21}))
            << name << " slice " << view.slice.index() << " half " << half;
      }
    }
  }
}

}  // namespace
}  // namespace sonar
