// SPDX-License-Identifier: Apache-2.0
#include "geo/map_projection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

GeoExtent about(double lat, double lon, double half_lat, double half_lon) {
  return {lat - half_lat, lat + half_lat, wrap_180(lon - half_lon), wrap_180(lon - half_lon) + 2.0 * half_lon};
}

struct Case {
  const char* begins = "";
  GeoExtent extent;
};

const Case kCases[] = {
    {"Lambert conformal conic", about(60.0, 4.0, 0.5, 2.0)},
    {"Lambert conformal conic", about(-45.0, 179.9, 1.0, 5.0)},  // across 180 degrees
    {"Transverse Mercator", about(58.0, 3.0, 3.0, 1.0)},
    {"Transverse Mercator", about(1.0, -179.95, 0.5, 1.0)},
    {"Mercator", about(5.0, 10.0, 3.0, 8.0)},
    {"Polar stereographic", about(70.5, 19.0, 0.2, 1.0)},
    {"Polar stereographic", about(85.0, 180.0, 0.5, 10.0)},
    {"Polar stereographic", about(-76.0, -160.0, 1.0, 5.0)},
};

TEST(MapProjection, ThereAndBackIsTheSamePlace) {
  for (const Case& c : kCases) {
    const MapProjection p(c.extent);
    EXPECT_EQ(p.name().rfind(c.begins, 0), 0U) << p.name();
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; j <= 8; ++j) {
        const Geographic place{c.extent.south_deg + (c.extent.north_deg - c.extent.south_deg) * i / 8.0,
                               wrap_180(c.extent.west_deg + (c.extent.east_deg - c.extent.west_deg) * j / 8.0)};
        const auto there = p.forward(place);
        ASSERT_TRUE(there);
        const auto back = p.inverse(*there);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->latitude_deg, place.latitude_deg, 1e-9) << p.name();
        EXPECT_NEAR(wrap_180(back->longitude_deg - place.longitude_deg), 0.0, 1e-9) << p.name();
      }
    }
  }
}

TEST(MapProjection, StepsOnTheMapAreTrueStepsTimesTheScaleInEveryDirection) {
  for (const Case& c : kCases) {
    const MapProjection p(c.extent);
    const Geographic place{c.extent.south_deg + 0.3 * (c.extent.north_deg - c.extent.south_deg),
                           wrap_180(c.extent.west_deg + 0.8 * (c.extent.east_deg - c.extent.west_deg))};
    const PlanePoint here = *p.forward(place);
    const double scale = p.scale_at(place);
    const double north = p.north_rad(place);
    EXPECT_NEAR(scale, 1.0, 0.02) << p.name();
    for (int bearing = 0; bearing < 360; bearing += 30) {
      const PlanePoint there = *p.forward(destination(place, 100.0, bearing));
      const double turned = north + rad_from_deg(bearing);
      EXPECT_NEAR(there.x - here.x, 100.0 * scale * std::sin(turned), 0.01) << p.name() << bearing;
      EXPECT_NEAR(there.y - here.y, 100.0 * scale * std::cos(turned), 0.01) << p.name() << bearing;
    }
  }
}

TEST(MapProjection, NothingJumpsAt180Degrees) {
  const MapProjection p(about(60.0, 180.0, 1.0, 2.0));
  const PlanePoint west = *p.forward({60.0, 179.999});
  const PlanePoint east = *p.forward({60.0, -179.999});
  // 0.002 degrees of longitude at 60 N are 0.002 * 55 800 m = 111.6 m.
  EXPECT_NEAR(east.x - west.x, 111.6, 0.2);
  EXPECT_NEAR(east.y, west.y, 0.1);
}

TEST(MapProjection, CopiesDrawTheSameMap) {
  const MapProjection a(kCases[0].extent);
  MapProjection b(kCases[5].extent);
  b = a;
  EXPECT_EQ(b.name(), a.name());
  EXPECT_EQ(*b.forward({60.1, 4.2}), *a.forward({60.1, 4.2}));
}

TEST(GeoExtent, TakesTheShorterWayRound) {
  const std::vector<Geographic> places{{60.0, 179.5}, {60.5, -179.0}, {61.0, 179.0}};
  const auto e = extent_of(places);
  ASSERT_TRUE(e);
  EXPECT_EQ(*e, (GeoExtent{60.0, 61.0, 179.0, 181.0}));
  EXPECT_NEAR(e->middle().longitude_deg, -180.0, 1e-12);
  EXPECT_TRUE(e->contains({60.2, -179.5}));
  EXPECT_FALSE(e->contains({60.2, -178.5}));
}

TEST(GeoExtent, NoPlaceNoExtent) {
  const std::vector<Geographic> places{{std::nan(""), 1.0}, {1.0, std::nan("")}};
  EXPECT_FALSE(extent_of(places));
}

TEST(GeoExtent, WidensByMetresAndStopsAtThePole) {
  const GeoExtent e = widened({60.0, 60.0, 4.0, 4.0}, 111'195.0);
  EXPECT_NEAR(e.north_deg, 61.0, 1e-9);
  // One degree of latitude is 1 / cos 61 degrees of longitude at the northern edge.
  EXPECT_NEAR(e.east_deg, 4.0 + 1.0 / std::cos(rad_from_deg(61.0)), 1e-9);
  const GeoExtent pole = widened({89.9, 89.95, 4.0, 5.0}, 20'000.0);
  EXPECT_EQ(pole.north_deg, 90.0);
  EXPECT_NEAR(pole.east_deg - pole.west_deg, 360.0, 1e-9);
}

}  // namespace
}  // namespace sonar
