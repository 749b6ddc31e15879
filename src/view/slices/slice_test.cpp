// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/slices/slice_example.h"

namespace sonar {
namespace {

using slice_example::hand_sector;
using slice_example::sectors;

std::vector<SliceView> views(const Sector& sector) {
  const int fan = sector.fans() / 2;
  const int beam = sector.beams() / 2;
  const Point<Sonar> inside = sector.centre(fan, beam, 60);
  return {{TopSlice{fan}},
          {TopSlice{0}, rad_from_deg(-35.0)},
          {SideSlice{beam}},
          {RangeSlice{60}},
          {horizontal_plane(inside.z + 7.0, 7.0)},
          {horizontal_plane(inside.z + 7.0, 7.0), rad_from_deg(120.0)},
          {vertical_plane(sector.azimuth_rad(beam) + 0.01)},
          {*vertical_plane(inside + Point<Sonar>{-20, 5, 0}, inside + Point<Sonar>{25, -3, 0})},
          {*oblique_plane(inside, {0.3, 0.4, -0.7})}};
}

/// The cells that hold a place by the sector's own fractional index; a place on a border is in both.
bool holds(const Sector& sector, const Voxel& v, const Point<Sonar>& p) {
  const SectorIndex i = sector.index_of(p);
  const double slack = 1e-6;
  return std::abs(i.fan - v.fan) <= 0.5 + slack && std::abs(i.beam - v.beam) <= 0.5 + slack &&
         std::abs(i.sample - v.sample) <= 0.5 + slack;
}

TEST(SliceMap, EveryPixelShowsTheCellThatHoldsIt) {
  for (const auto& [name, sector] : sectors()) {
    for (const SliceView& view : views(sector)) {
      const auto extent = whole_extent(sector, view);
      ASSERT_TRUE(extent.has_value()) << name << " slice " << view.slice.index();
      const SliceMap map(sector, view, *extent, {61, 47});
      int shown = 0;
      for (int y = 0; y < 47; ++y) {
        for (int x = 0; x < 61; ++x) {
          const PixelPoint pixel{x + 0.5, y + 0.5};
          const Point<Sonar> p = map.point_at(pixel);
          const auto voxel = map.voxel_at(pixel);
          if (voxel) {
            ++shown;
            ASSERT_TRUE(holds(sector, *voxel, p)) << name << " slice " << view.slice.index();
            continue;
          }
          // Behind the sonar a side slice has the beams of the other side, which are not its own.
          const bool behind = std::holds_alternative<SideSlice>(view.slice) && map.slice_coordinates(pixel).x < 0.0;
          if (!behind && !std::holds_alternative<RangeSlice>(view.slice) && norm(p) > 1e-6) {
            ASSERT_FALSE(sector.contains(sector.index_of(p))) << name << " slice " << view.slice.index();
          }
        }
      }
      EXPECT_GT(shown, 60) << name << " slice " << view.slice.index();
    }
  }
}

// Zoomed in on where a voxel is said to be, the middle pixel shows it.
TEST(SliceMap, VoxelsAreWhereTheyAreSaidToBe) {
  for (const auto& [name, sector] : sectors()) {
    for (SliceView view : views(sector)) {
      const SliceMap map(sector, view, *whole_extent(sector, view), {160, 120});
      int tried = 0;
      for (std::size_t i = 0; i < map.voxels().size(); i += 37) {
        const PixelPoint at{static_cast<double>(i % 160) + 0.5, static_cast<double>(i / 160) + 0.5};
        const auto voxel = map.voxel_at(at);
        if (!voxel) continue;
        const auto place = map.place_of(*voxel);
        ASSERT_TRUE(place.has_value()) << name << " slice " << view.slice.index();
        const PixelPoint c = map.slice_coordinates(*place);
        const double r = 1e-4;
        const SliceMap zoomed(sector, view, {c.x - r, c.y - r, c.x + r, c.y + r}, {3, 3});
        ASSERT_EQ(zoomed.voxel_at({1.5, 1.5}), voxel) << name << " slice " << view.slice.index();
        ++tried;
      }
      EXPECT_GT(tried, 5) << name;
    }
  }
}

TEST(SliceMap, VoxelsOutsideTheSliceHaveNoPlace) {
  const Sector sector = hand_sector();
  const SliceView top{TopSlice{4}};
  const SliceMap map(sector, top, *whole_extent(sector, top), {100, 100});
  EXPECT_FALSE(map.place_of({3, 3, 20}).has_value());
  EXPECT_FALSE(map.place_of({4, 7, 20}).has_value());
  EXPECT_FALSE(map.place_of({4, 3, -1}).has_value());
  const SliceView plane{horizontal_plane(50.0, 0.0)};
  const SliceMap level(sector, plane, *whole_extent(sector, plane), {100, 100});
  EXPECT_FALSE(level.place_of({7, 3, 40}).has_value());  // elevation 0: at most 200 sin 5 = 17 m deep
  EXPECT_FALSE(level.voxel_at({-1.0, 5.0}).has_value());
  EXPECT_FALSE(level.voxel_at({std::numeric_limits<double>::quiet_NaN(), 5.0}).has_value());
}

// Voxel (fan 4, beam 3, sample 20): elevation -30, azimuth 270 (port), range 100 m.
TEST(SliceMap, PlacesByHand) {
  const Sector sector = hand_sector();
  const Voxel v{4, 3, 20};
  const double h = 100.0 * std::cos(rad_from_deg(30.0));  // 86.6 m
  const auto at = [&](const SliceView& view) {
    const SliceMap map(sector, view, {-200, -200, 200, 200}, {400, 400});
    return map.slice_coordinates(*map.place_of(v));
  };
  const auto near = [](PixelPoint p, double x, double y) {
    EXPECT_NEAR(p.x, x, 1e-6);
    EXPECT_NEAR(p.y, y, 1e-6);
  };
  near(at({TopSlice{4}}), -h, 0.0);                       // ship-up: port is left
  near(at({TopSlice{4}, rad_from_deg(270.0)}), 0.0, -h);  // port up
  near(at({TopSlice{4}, rad_from_deg(-90.0)}), 0.0, -h);  // heading 90: north is to port
  near(at({SideSlice{3}}), h, 50.0);
  near(at({RangeSlice{20}}), 270.0, 30.0);  // y is minus the elevation
  near(at({horizontal_plane(57.0, 7.0)}), -h, 0.0);
  near(at({vertical_plane(rad_from_deg(270.0))}), h, 50.0);
  // Along the ship, 80 m to port of it, seen from port (a aft, b fore: left to right is towards the bow seen from
  // starboard).
  near(at({*vertical_plane({-10, -h, 3}, {10, -h, 90})}), 10.0, 50.0);
}

/// Area of all pixels that show a voxel, in units of the slice.
double area(const Sector& sector, const SliceView& view, const SliceExtent& extent, const Voxel& v) {
  const PixelSize size{900, 900};
  const SliceMap map(sector, view, extent, size);
  const std::int32_t number = (v.fan * sector.beams() + v.beam) * sector.range().count + v.sample;
  const auto pixels = std::count(map.voxels().begin(), map.voxels().end(), number);
  return static_cast<double>(pixels) * (extent.x1 - extent.x0) * (extent.y1 - extent.y0) / 810000.0;
}

// The same voxel: range 97.5 to 102.5 m, (r2^2 - r1^2) / 2 = 500 m^2 per radian, cells of 10 degrees.
TEST(SliceMap, AreasByHand) {
  const Sector sector = hand_sector();
  const Voxel v{4, 3, 20};
  const double ten = rad_from_deg(10.0);
  const double c = std::cos(rad_from_deg(30.0));
  EXPECT_NEAR(area(sector, {TopSlice{4}}, {-96, -15, -76, 15}, v), 500.0 * ten * c * c, 0.5);
  EXPECT_NEAR(area(sector, {SideSlice{3}}, {70, 35, 100, 65}, v), 500.0 * ten, 0.5);
  EXPECT_NEAR(area(sector, {RangeSlice{20}}, {260, 20, 280, 40}, v), 100.0, 1.0);
  // At 50 m below the sonar the elevations -35 to -25 reach from 71 to 107 m, beyond both shells there.
  EXPECT_NEAR(area(sector, {horizontal_plane(50.0, 0.0)}, {-96, -15, -76, 15}, v), 500.0 * ten, 0.5);
  EXPECT_NEAR(area(sector, {vertical_plane(rad_from_deg(270.0))}, {70, 35, 100, 65}, v), 500.0 * ten, 0.5);
}

TEST(SliceMap, FitsTheSameGeometryOnly) {
  const Sector sector = hand_sector();
  const SliceView view{TopSlice{4}};
  const SliceMap map(sector, view, {-200, -200, 200, 200}, {40, 40});
  EXPECT_TRUE(map.fits(hand_sector(), view, {40, 40}));
  EXPECT_FALSE(map.fits(hand_sector(), view, {41, 40}));
  EXPECT_FALSE(map.fits(hand_sector(), {TopSlice{5}}, {40, 40}));
  EXPECT_FALSE(map.fits(hand_sector(), {TopSlice{4}, 0.1}, {40, 40}));
  EXPECT_FALSE(map.fits(sectors()[0].sector, view, {40, 40}));
}

TEST(Slice, PlanesAreRightHandedAsSeen) {
  for (const Point<Sonar> n : {Point<Sonar>{0.3, 0.2, -1.0}, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {-0.5, 0.8, 0.4}}) {
    const auto plane = oblique_plane({1, 2, 3}, n);
    ASSERT_TRUE(plane.has_value());
    const auto& r = plane->right;
    const auto& d = plane->down;
    // right x down points away from the viewer.
    const Point<Sonar> away{r.y * d.z - r.z * d.y, r.z * d.x - r.x * d.z, r.x * d.y - r.y * d.x};
    EXPECT_NEAR(norm(away + n * (1.0 / norm(n))), 0.0, 1e-12);
    EXPECT_NEAR(r.z, 0.0, 1e-12);
    EXPECT_GT(d.z, 0.0);
  }
  EXPECT_EQ(oblique_plane({}, {0, 0, -2})->right, (Point<Sonar>{0, 1, 0}));
  EXPECT_EQ(oblique_plane({}, {0, 0, -2})->down, (Point<Sonar>{-1, 0, 0}));
}

TEST(Slice, BadSlicesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Sector sector = hand_sector();
  EXPECT_EQ(check_slice(sector, {TopSlice{8}}).error().text, "there is no fan 8; expected 0 to 7");
  EXPECT_EQ(check_slice(sector, {SideSlice{-1}}).error().text, "there is no beam -1; expected 0 to 6");
  EXPECT_EQ(check_slice(sector, {RangeSlice{41}}).error().text, "there is no sample 41; expected 0 to 40");
  EXPECT_FALSE(check_slice(sector, {horizontal_plane(nan, 7.0)}).has_value());
  EXPECT_FALSE(check_slice(sector, {TopSlice{0}, nan}).has_value());
  EXPECT_FALSE(check_slice(sector, {TopSlice{0}, 0.0, SliceExtent{1, 0, 1, 5}}).has_value());
  EXPECT_FALSE(vertical_plane({1, 2, 0}, {1, 2, 50}).has_value());
  EXPECT_FALSE(oblique_plane({}, {0, 0, 0}).has_value());
  EXPECT_FALSE(oblique_plane({}, {0, nan, 0}).has_value());
  EXPECT_FALSE(whole_extent(sector, {horizontal_plane(500.0, 0.0)}).has_value());
  EXPECT_FALSE(whole_extent(sector, {horizontal_plane(-50.0, 0.0)}).has_value());
}

}  // namespace
}  // namespace sonar
