// SPDX-License-Identifier: Apache-2.0
#include "school/measure/surface_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "school/test_body.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr double kPi = std::numbers::pi;

Sector ms70() { return test::grid().sector(test::range_axis(900)); }
Point<Sonar> towards(double range_m, double elevation_deg = -22.0) {
  return Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(268.0)) * range_m;
}
PingMask ball(const Sector& sector, const Point<Sonar>& centre, double radius_m) {
  return test::body_mask(sector, [&](const Point<Sonar>& p) { return norm(p - centre) < radius_m; });
}

// Faces of the cells themselves would be half as much again.
TEST(SurfaceArea, ABallOfFiveBeamsOrMoreHasItsSphere) {
  const Sector sector = ms70();
  for (const double range_m : {60.0, 130.0, 200.0}) {
    for (const double across : {5.0, 8.0, 12.0}) {
      const double radius_m = range_m * rad_from_deg(2.45) * across / 2.0;
      const double surface = surface_m2(ball(sector, towards(range_m), radius_m).runs, sector);
      EXPECT_NEAR(surface / (4.0 * kPi * radius_m * radius_m), 1.0, across < 7.0 ? 0.06 : 0.04)
          << range_m << " " << across;
    }
  }
}

// Prolate and oblate ones have surfaces in closed form; they lie level, and turned towards the beam by half a right angle.
TEST(SurfaceArea, EllipsoidsOfRevolution) {
  const Sector sector = ms70();
  const double a = 30.0;
  const double c = 12.0;
  const double prolate_e = std::sqrt(1.0 - c * c / (a * a));
  const double prolate = 2.0 * kPi * c * c * (1.0 + a / (c * prolate_e) * std::asin(prolate_e));
  const double oblate = 2.0 * kPi * a * a * (1.0 + c * c / (a * a) / prolate_e * std::atanh(prolate_e));
  const Point<Sonar> centre = towards(120.0);
  for (const double turned_deg : {0.0, 45.0, 90.0}) {
    const double x = std::cos(rad_from_deg(turned_deg));
    const double y = std::sin(rad_from_deg(turned_deg));
    const PingMask cigar = test::body_mask(sector, [&](const Point<Sonar>& p) {
      const Point<Sonar> d = p - centre;
      const double along = (d.x * x + d.y * y) / a;
      const double across = (d.y * x - d.x * y) / c;
      return along * along + across * across + d.z * d.z / (c * c) < 1.0;
    });
    EXPECT_NEAR(surface_m2(cigar.runs, sector) / prolate, 1.0, 0.05) << turned_deg;
  }
  const PingMask disc = test::body_mask(sector, [&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - centre;
    return (d.x * d.x + d.y * d.y) / (a * a) + d.z * d.z / (c * c) < 1.0;
  });
  EXPECT_NEAR(surface_m2(disc.runs, sector) / oblate, 1.0, 0.05);
}

// A half ring of a round tube: 2 pi^2 R r of a whole one, halved, and the two ends.
TEST(SurfaceArea, ABentTube) {
  const Sector sector = ms70();
  const Point<Sonar> centre = towards(80.0);
  const double ring = 25.0;
  const double tube = 12.0;
  const PingMask banana = test::body_mask(sector, [&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - centre;
    return d.x > 0.0 && std::hypot(std::hypot(d.x, d.y) - ring, d.z) < tube;
  });
  const double surface = 2.0 * kPi * kPi * ring * tube + 2.0 * kPi * tube * tube;
  EXPECT_NEAR(surface_m2(banana.runs, sector) / surface, 1.0, 0.05);
}

// The same cells in a sector twice as far and twice as coarse along range.
TEST(SurfaceArea, GrowsAsTheSquareOfTheRange) {
  const Sector sector = ms70();
  const RangeAxis axis = sector.range();
  const Sector doubled = test::grid().sector({2.0 * axis.first_m, 2.0 * axis.spacing_m, axis.count});
  const PingMask mask = ball(sector, towards(150.0), 20.0);
  EXPECT_NEAR(surface_m2(mask.runs, doubled) / surface_m2(mask.runs, sector), 4.0, 1e-9);
  EXPECT_NEAR(area_from_above_m2(mask.runs, doubled) / area_from_above_m2(mask.runs, sector), 4.0, 1e-9);
}

// A slab of one fan: both sides count, though they lie in the same beams.
TEST(SurfaceArea, AThinLayerHasTwoSides) {
  const Sector sector = ms70();
  PingMask layer;
  for (int beam = 4; beam < 20; ++beam) layer.runs.push_back({10 * 25 + beam, 300, 100});
  const double sides = rad_from_deg(2.5) * 16.0 *
                       (std::cos(sector.elevation_bounds(10).lower) + std::cos(sector.elevation_bounds(10).upper)) *
                       (std::pow(sector.range().range_m(399.5), 2) - std::pow(sector.range().range_m(299.5), 2)) / 2.0;
  const double surface = surface_m2(layer.runs, sector);
  EXPECT_GT(surface, sides);
  EXPECT_LT(surface, 1.3 * sides) << "and the rim";
}

TEST(AreaFromAbove, ACellByHandAndTwoOneAboveTheOther) {
  const Sector sector = ms70();
  const RangeAxis& axis = sector.range();
  const AngleBounds e = sector.elevation_bounds(10);
  const double near_m = axis.range_m(299.5) * std::cos(e.lower);
  const double far_m = axis.range_m(399.5) * std::cos(e.upper);
  const double one = rad_from_deg(2.5) * (far_m * far_m - near_m * near_m) / 2.0;
  const std::vector<sonar::Run> lower{{10 * 25 + 7, 300, 100}};
  EXPECT_NEAR(area_from_above_m2(lower, sector), one, 1e-9 * one);
  // the fan above, within the same stretch
  const std::vector<sonar::Run> both{{10 * 25 + 7, 300, 100}, {11 * 25 + 7, 310, 50}};
  EXPECT_NEAR(area_from_above_m2(both, sector), one, 1e-9 * one);
  const std::vector<sonar::Run> beside{{10 * 25 + 7, 300, 100}, {10 * 25 + 8, 300, 100}};
  EXPECT_NEAR(area_from_above_m2(beside, sector), 2.0 * one, 1e-9 * one);
}

}  // namespace
}  // namespace sonar
