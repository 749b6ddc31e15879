// SPDX-License-Identifier: Apache-2.0
#include "geo/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "geo/sector.h"

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const SoundProfile kSummer{{0, 1505}, {15, 1503}, {25, 1488}, {60, 1478}, {110, 1481}, {200, 1483.5}};

// Between its nodes too, 0.1 m from the exact ray, at any azimuth, which stays.
TEST(Refraction, IsTheExactRay) {
  const Refraction refraction(kSummer, 7.0, 1480.0, 500.0);
  for (const double elevation_deg : {-89.9, -44.87, -20.3, -7.61, -3.13, -0.88, -0.1, 0.12, 2.2, 33.0}) {
    for (const double range_m : {3.3, 77.7, 251.1, 499.5}) {
      SoundRay ray(kSummer, 7.0, elevation_deg * kDegree);
      ray.advance(range_m / 1480.0);
      const Point<Sonar> at = refraction.bent(Sector::direction(elevation_deg * kDegree, 4.0) * range_m);
      EXPECT_NEAR(std::hypot(at.x, at.y), ray.place().distance_m, 0.1) << elevation_deg << ' ' << range_m;
      EXPECT_NEAR(at.z, ray.place().depth_m - 7.0, 0.1) << elevation_deg << ' ' << range_m;
      EXPECT_NEAR(std::remainder(std::atan2(at.y, at.x) - 4.0, 2 * std::numbers::pi), 0.0, 1e-9);
    }
  }
}

TEST(Refraction, WithoutAGradientOnlyTheSpeedCounts) {
  const Refraction same({{0.0, 1500.0}}, 7.0, 1500.0, 500.0);
  const Refraction faster({{0.0, 1530.0}}, 7.0, 1500.0, 500.0);
  const Point<Sonar> place{30.0, -300.0, 120.0};
  EXPECT_NEAR(norm(same.bent(place) - place), 0.0, 1e-3);
  EXPECT_NEAR(norm(faster.bent(place) - place * 1.02), 0.0, 2e-3);
  EXPECT_EQ(same.bent({}), (Point<Sonar>{}));
}

TEST(Refraction, StraightensWhatItBends) {
  const Refraction refraction(kSummer, 7.0, 1480.0, 500.0);
  for (const double elevation_deg : {-60.0, -30.0, -12.0, -6.0}) {
    for (const double range_m : {20.0, 200.0, 480.0}) {
      const Point<Sonar> place = Sector::direction(elevation_deg * kDegree, 1.0) * range_m;
      EXPECT_NEAR(norm(refraction.straightened(refraction.bent(place)) - place), 0.0, 1e-3)
          << elevation_deg << ' ' << range_m;
    }
  }
}

// Level rays over a thermocline part and cross: what is straightened is bent to where it was, along one of the rays that come there.
TEST(Refraction, StraightensWhereRaysCross) {
  const Refraction refraction(kSummer, 7.0, 1480.0, 500.0);
  for (double elevation_deg = -5.0; elevation_deg < 2.0; elevation_deg += 0.0731) {
    for (const double range_m : {60.0, 250.0, 333.3, 480.0}) {
      const Point<Sonar> there = refraction.bent(Sector::direction(elevation_deg * kDegree, 1.0) * range_m);
      const Point<Sonar> straight = refraction.straightened(there);
      EXPECT_NEAR(norm(refraction.bent(straight) - there), 0.0, 0.01) << elevation_deg << ' ' << range_m;
      EXPECT_NEAR(std::remainder(std::atan2(straight.y, straight.x) - 1.0, 2 * std::numbers::pi), 0.0, 1e-9);
    }
  }
}

// As where a ping's roll is not known: what is looked up must not lie outside the table.
TEST(Refraction, OfNoPlaceNoneIsTold) {
  const Refraction refraction(kSummer, 7.0, 1480.0, 500.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Point<Sonar>& place : {Point<Sonar>{nan, 1.0, 1.0}, {100.0, 1.0, nan}, {nan, nan, nan}}) {
    EXPECT_TRUE(std::isnan(refraction.bent(place).z));
  }
}

// A placement that knows rays levels by them, after roll and pitch; without them all stays as it is.
TEST(Refraction, EntersWherePlacesAreLevelled) {
  Placement placement{.transducer = {60.0, 4.0}, .heading_rad = 1.0, .transducer_depth_m = 7.0};
  placement.roll_rad = 2.0 * kDegree;
  const Point<Sonar> place = Sector::direction(-10.0 * kDegree, 1.5) * 300.0;
  const Point<Sonar> straight = levelled(place, placement);
  const auto rays = std::make_shared<const Refraction>(kSummer, 7.0, 1480.0, 500.0);
  placement.rays = rays;
  EXPECT_EQ(levelled(place, placement), rays->bent(straight));
  EXPECT_GT(norm(levelled(place, placement) - straight), 1.0);
  EXPECT_EQ(levelled_direction(place, placement), straight);
  EXPECT_NEAR(norm(unlevelled(levelled(place, placement), placement) - place), 0.0, 1e-3);
}

}  // namespace
}  // namespace sonar
