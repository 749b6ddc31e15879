// SPDX-License-Identifier: Apache-2.0
#include "school/measure/movement.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr TimeNs kStart = 1'600'000'000 * kSecondNs;
constexpr Geographic kHere{60, 4};

/// A ship that sails north at 5 m/s from kHere, a ping every 5 s.
std::vector<PingNavigation> northward(int pings) {
  std::vector<PingNavigation> out;
  for (int i = 0; i < pings; ++i) {
    PingNavigation at;
    at.time = kStart + i * 5 * kSecondNs;
    at.transducer = to_geographic(Point<Enu>{0.0, 25.0 * i, 0.0}, kHere);
    at.heading_deg = 0.0;
    at.course_deg = 0.0;
    at.speed_mps = 5.0;
    out.push_back(at);
  }
  return out;
}

/// A school on a straight way, as the ship sees it.
std::vector<SchoolPingRow> school(const std::vector<PingNavigation>& ship, Point<Enu> from, Point<Enu> velocity) {
  std::vector<SchoolPingRow> rows;
  for (std::size_t i = 0; i < ship.size(); ++i) {
    SchoolPingRow row;
    row.ping_index = static_cast<std::int64_t>(i);
    row.time_utc = ship[i].time;
    const Geographic at = to_geographic(from + velocity * (5.0 * static_cast<double>(i)), kHere);
    row.latitude = at.latitude_deg;
    row.longitude = at.longitude_deg;
    row.depth_m = 50.0 + static_cast<double>(i);  // sinks by 0.2 m/s
    row.bearing_deg = geodesic(ship[i].transducer, at).bearing_deg;
    rows.push_back(row);
  }
  return rows;
}

// By hand: 300 m ahead and 400 m aside, meeting at 6 and passing at 400: 300 / 6 = 50 s.
TEST(ClosestApproach, ByHand) {
  const auto found = closest_approach({-400, 300, 0}, {0, -6, 0});
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->time_s, 50.0);
  EXPECT_DOUBLE_EQ(found->distance_m, 400.0);
  EXPECT_DOUBLE_EQ(closest_approach({-400, -300, 0}, {0, -6, 0})->time_s, -50.0) << "past";
  EXPECT_NEAR(closest_approach({30, 40, 0}, {-3, -4, 0})->distance_m, 0.0, 1e-12) << "head on";
  EXPECT_FALSE(closest_approach({30, 40, 0}, {0.1, 0.1, 0})) << "they hardly move against each other";
}

// By brute force: the least of distances worked out every millisecond.
TEST(ClosestApproach, IsTheLeastDistance) {
  const Point<Enu> at{-123.0, 456.0, 0.0};
  const Point<Enu> relative{0.7, -4.3, 0.0};
  double least_m = 1e9;
  double when_s = 0.0;
  for (int i = 0; i < 300'000; ++i) {
    const Point<Enu> then = at + relative * (i * 1e-3);
    const double distance_m = std::hypot(then.x, then.y);
    if (distance_m < least_m) {
      least_m = distance_m;
      when_s = i * 1e-3;
    }
  }
  const auto found = closest_approach(at, relative);
  EXPECT_NEAR(found->time_s, when_s, 1e-3);
  EXPECT_NEAR(found->distance_m, least_m, 1e-6);
}

// The school swims 1 m/s west, away from a ship that it lies west of: at ping 10 the ship is 250 m on.
TEST(Movement, OfASchoolThatFlees) {
  const auto ship = northward(40);
  auto rows = school(ship, {-200, 250, 0}, {-1, 0, 0});
  add_movement(rows, ShipWay(ship), {}, nullptr);
  const SchoolPingRow& abeam = rows[10];  // 250 m west of the ship
  EXPECT_NEAR(abeam.speed_smoothed_mps, 1.0, 1e-3);
  EXPECT_NEAR(abeam.course_smoothed_deg, 270.0, 0.1);
  EXPECT_NEAR(abeam.vertical_speed_smoothed_mps, 0.2, 1e-9);
  EXPECT_NEAR(abeam.relative_bearing_deg, -90.0, 0.1);
  EXPECT_NEAR(abeam.speed_away_mps, 1.0, 1e-3);
  EXPECT_NEAR(abeam.course_away_deg, 0.0, 0.2);
  EXPECT_EQ(abeam.ship_speed_mps, 5.0);
  // r = (-250, 0), v = (-1, -5): t = -250 / 26, and the distance then 250 x 5 / sqrt(26).
  EXPECT_NEAR(abeam.time_to_cpa_s, -250.0 / 26.0, 0.02);
  EXPECT_NEAR(abeam.cpa_m, 250.0 * 5.0 / std::sqrt(26.0), 0.1);
  EXPECT_TRUE(std::isnan(abeam.speed_water_smoothed_mps));
  // At ping 0 it lies 200 m west and 250 m ahead: away is (-200, 250) / 320.2.
  EXPECT_NEAR(rows[0].speed_away_mps, 200.0 / std::hypot(200.0, 250.0), 1e-3);
}

// Water that drifts 1 m/s west carries the school; it does not swim.
TEST(Movement, ACarriedSchoolDoesNotFlee) {
  const auto ship = northward(40);
  auto rows = school(ship, {-200, 250, 0}, {-1, 0, 0});
  const CurrentProfiles water{{kStart, kHere, {{50, -1.0, 0.0}, {70, -1.0, 0.0}, {90, -1.0, 0.0}}}};
  const WaterCurrents currents{&water, {}, 0.01};
  add_movement(rows, ShipWay(ship), {}, &currents);
  EXPECT_NEAR(rows[10].speed_away_mps, 1.0, 1e-3);
  EXPECT_NEAR(rows[10].speed_away_water_mps, 0.0, 1e-3);
  EXPECT_NEAR(rows[10].speed_water_smoothed_mps, 0.0, 0.02);
}

TEST(Movement, CutCentresHaveNoVelocityButAnApproach) {
  const auto ship = northward(20);
  auto rows = school(ship, {-200, 250, 0}, {-1, 0, 0});
  for (auto& row : rows) row.edge_flags = kEdgeFore;
  add_movement(rows, ShipWay(ship), {}, nullptr);
  EXPECT_TRUE(std::isnan(rows[5].speed_smoothed_mps));
  EXPECT_TRUE(std::isnan(rows[5].speed_away_mps));
  EXPECT_NEAR(rows[5].time_to_cpa_s, 125.0 / 5.0, 0.05) << "taken for still";
}

// Turned back: what lies 10 m beside the way sailed is 10 m from the wake, however far from the ship; ten minutes later
// the wake is gone.
TEST(Movement, WakeIsWhereTheShipWas) {
  const auto ship = northward(200);
  const ShipWay way(ship);
  const Geographic beside = to_geographic(Point<Enu>{-10.0, 260.0, 0.0}, kHere);
  EXPECT_NEAR(way.wake_distance_m(40, beside), 10.0, 0.01);
  EXPECT_NEAR(way.wake_distance_m(0, beside), std::hypot(10.0, 260.0), 0.01) << "it was not there yet";
  EXPECT_GT(way.wake_distance_m(199, beside), 1000.0);
}

TEST(Movement, WithoutPositionsNothingIsKnown) {
  std::vector<PingNavigation> ship(20);
  for (int i = 0; i < 20; ++i) ship[static_cast<std::size_t>(i)].time = kStart + i * 5 * kSecondNs;
  auto rows = school(northward(20), {-200, 250, 0}, {-1, 0, 0});
  for (auto& row : rows) row.latitude = row.longitude = row.bearing_deg = kUnknown;
  add_movement(rows, ShipWay(ship), {}, nullptr);
  EXPECT_TRUE(std::isnan(rows[10].relative_bearing_deg));
  EXPECT_TRUE(std::isnan(rows[10].time_to_cpa_s));
  EXPECT_TRUE(std::isnan(rows[10].wake_distance_m));
}

/// Three pings of a school at rest 250 m west of the ship's way, whose centre is seen at -247, -250 and -247 m: about its
/// line, which does not move, it scatters by 1, -2, 1 m, of variance 6 m2 for one degree of freedom. Depths do the same.
std::vector<SchoolPingRow> wandering(const std::vector<PingNavigation>& ship, double north_m) {
  auto rows = school(ship, {-248, north_m, 0}, {0, 0, 0});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double off_m = i == 1 ? -2.0 : 1.0;
    const Geographic at = to_geographic(Point<Enu>{-248.0 + off_m, north_m, 0.0}, kHere);
    rows[i].latitude = at.latitude_deg;
    rows[i].longitude = at.longitude_deg;
    rows[i].depth_m = 50.0 + off_m;
  }
  return rows;
}

// By hand, deviations that are not alike: the slope's variance is 6 / (25 + 25). At the middle ping, 25 m on, the ship has
// 100 m to go at 5 m/s: 20 s. The distance across has the variance of the place and 20^2 that of the velocity,
// 6 (1 + 400 / 50) = 54. The time changes by -2 r / v^2 with the speed across, 250 / 25 = 10 s per m/s: 10^2 x 6 / 50 = 12.
TEST(MovementErrors, OfAnApproachByHand) {
  const auto ship = northward(3);
  auto rows = wandering(ship, 125.0);
  add_movement(rows, ShipWay(ship), {}, nullptr);
  EXPECT_NEAR(rows[1].time_to_cpa_s, 20.0, 0.01);
  EXPECT_NEAR(rows[1].cpa_m, 250.0, 0.1);
  EXPECT_NEAR(rows[1].cpa_se_m, std::sqrt(54.0), 0.01);
  EXPECT_NEAR(rows[1].time_to_cpa_se_s, std::sqrt(12.0), 0.01);
  EXPECT_NEAR(rows[1].vertical_speed_smoothed_se_mps, std::sqrt(6.0 / 50.0), 1e-6);
  // At the first ping 25 s are to go, and what the place is too far west lets the line seem to go east: a covariance of
  // -5 / 50 of the variance. 6 (1 + 625 / 50 - 2 x 25 / 10) = 51.
  EXPECT_NEAR(rows[0].cpa_se_m, std::sqrt(51.0), 0.01);
  // Past by as much at the last one, which sees it from behind: the same by symmetry.
  auto behind = wandering(ship, -75.0);
  add_movement(behind, ShipWay(ship), {}, nullptr);
  EXPECT_NEAR(behind[2].time_to_cpa_s, -25.0, 0.01);
  EXPECT_NEAR(behind[2].cpa_se_m, std::sqrt(51.0), 0.01);
}

TEST(MovementErrors, NothingIsToldOfASchoolThatIsTakenForStill) {
  const auto ship = northward(3);
  auto rows = wandering(ship, 125.0);
  for (auto& row : rows) row.edge_flags = kEdgeFore;
  add_movement(rows, ShipWay(ship), {}, nullptr);
  EXPECT_TRUE(std::isfinite(rows[1].cpa_m));
  EXPECT_TRUE(std::isnan(rows[1].cpa_se_m));
  EXPECT_TRUE(std::isnan(rows[1].time_to_cpa_se_s));
  EXPECT_TRUE(std::isnan(rows[1].vertical_speed_smoothed_se_mps));
}

/// Deviations of variance 1 with correlation exp(-dt / tau), at even steps.
std::vector<double> alike(std::mt19937& random, int count, double step_s, double tau_s) {
  std::normal_distribution<double> normal;
  const double phi = tau_s > 0.0 ? std::exp(-step_s / tau_s) : 0.0;
  std::vector<double> out{normal(random)};
  for (int i = 1; i < count; ++i) out.push_back(phi * out.back() + std::sqrt(1.0 - phi * phi) * normal(random));
  return out;
}

// Monte Carlo: 20 000 series, each with its own line.
TEST(MovementErrors, APlaceAndItsLinesSlopeErrTogether) {
  std::mt19937 random(20260103);
  const std::vector<double> t{0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0};
  for (const double tau_s : {0.0, 8.0, 40.0}) {
    std::vector<double> sum(t.size(), 0.0);
    constexpr int kSeries = 20'000;
    for (int k = 0; k < kSeries; ++k) {
      const auto x = alike(random, 7, 5.0, tau_s);
      double slope = 0.0;
      for (std::size_t i = 0; i < t.size(); ++i) slope += (t[i] - 15.0) * x[i] / 700.0;
      for (std::size_t i = 0; i < t.size(); ++i) sum[i] += slope * x[i] / kSeries;
    }
    // The slope's deviation is at most 0.06, so that a mean of 20 000 products has an error of 4e-4 at the most.
    for (std::size_t i = 0; i < t.size(); ++i) {
      EXPECT_NEAR(covariance_with_slope(t, tau_s, i), sum[i], 1.5e-3) << tau_s << ' ' << i;
    }
  }
}

// Monte Carlo: a school swims 1.3 m/s south-west and is seen with errors of 4 m north, 2 m east and 1 m down, each ping its
// own. (Where they are alike for two pings the errors told are a fifth too large, as the scatter is.) The spread over 250 voyages is the error that they tell, to 15 %, in the middle and at an end.
TEST(MovementErrors, AreTheSpreadOfManyVoyages) {
  constexpr int kPings = 60;
  const auto ship = northward(kPings);
  const ShipWay way(ship);
  std::mt19937 random(20260104);
  SummariseParams params;
  params.movement_window_s = 60.0;
  constexpr int kVoyages = 250;
  struct Figure {
    const char* name;
    double SchoolPingRow::*value;
    double SchoolPingRow::*error;
  };
  constexpr std::array<Figure, 5> kFigures{
      {{"time_to_cpa_s", &SchoolPingRow::time_to_cpa_s, &SchoolPingRow::time_to_cpa_se_s},
       {"cpa_m", &SchoolPingRow::cpa_m, &SchoolPingRow::cpa_se_m},
       {"vertical", &SchoolPingRow::vertical_speed_smoothed_mps, &SchoolPingRow::vertical_speed_smoothed_se_mps},
       {"course", &SchoolPingRow::course_smoothed_deg, &SchoolPingRow::course_smoothed_se_deg},
       {"course away", &SchoolPingRow::course_away_deg, &SchoolPingRow::course_away_se_deg}}};
  std::array<std::array<double, 3>, 2 * kFigures.size()> sums{};  // of values, squares, variances told
  std::array<int, 2 * kFigures.size()> counts{};
  for (int k = 0; k < kVoyages; ++k) {
    std::array<std::vector<double>, 3> off;
    for (auto& one : off) one = alike(random, kPings, 5.0, 0.0);
    std::vector<SchoolPingRow> rows = school(ship, {-200, 500, 0}, {-0.9, -0.9, 0});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double t = 5.0 * static_cast<double>(i);
      const Geographic at =
          to_geographic(Point<Enu>{-200.0 - 0.9 * t + 2.0 * off[0][i], 500.0 - 0.9 * t + 4.0 * off[1][i], 0.0}, kHere);
      rows[i].latitude = at.latitude_deg;
      rows[i].longitude = at.longitude_deg;
      rows[i].depth_m += off[2][i];
    }
    add_movement(rows, way, params, nullptr);
    for (std::size_t f = 0; f < 2 * kFigures.size(); ++f) {
      const SchoolPingRow& row = rows[f % 2 == 0 ? 30 : 0];
      const Figure& figure = kFigures[f / 2];
      const double value = row.*figure.value;
      const double error = row.*figure.error;
      if (!std::isfinite(value) || !std::isfinite(error)) continue;
      ++counts[f];
      sums[f][0] += value;
      sums[f][1] += value * value;
      sums[f][2] += error * error;
    }
  }
  for (std::size_t f = 0; f < 2 * kFigures.size(); ++f) {
    ASSERT_GT(counts[f], 0.99 * kVoyages) << kFigures[f / 2].name;
    const double mean = sums[f][0] / counts[f];
    const double spread = std::sqrt(sums[f][1] / counts[f] - mean * mean);
    const double told = std::sqrt(sums[f][2] / counts[f]);
    EXPECT_NEAR(told / spread, 1.0, 0.15) << kFigures[f / 2].name << (f % 2 == 0 ? " in the middle" : " at the end");
  }
}

// A carried school: one profile of noise 0.05 m/s each way is all that errs, whatever the direction. By hand.
TEST(MovementErrors, ThroughTheWaterHaveTheProfilesNoise) {
  const auto ship = northward(40);
  auto rows = school(ship, {-200, 250, 0}, {-1, 0, 0});
  const CurrentProfiles water{{kStart, kHere, {{50, -0.4, 0.1}, {70, -0.4, 0.1}, {90, -0.4, 0.1}}}};
  const WaterCurrents currents{&water, {}, 0.05};
  add_movement(rows, ShipWay(ship), {}, &currents);
  EXPECT_NEAR(rows[10].speed_away_water_mps, 0.6, 1e-3);
  EXPECT_NEAR(rows[10].speed_away_water_se_mps, 0.05, 1e-4);
  EXPECT_NEAR(rows[10].speed_water_smoothed_se_mps, 0.05, 1e-4);
  EXPECT_NEAR(rows[10].course_water_smoothed_se_deg, deg_from_rad(0.05 / std::hypot(0.6, 0.1)), 0.05);
  EXPECT_LT(rows[10].speed_away_se_mps, 1e-3) << "over ground nothing errs";
  const WaterCurrents unknown{&water, {}, kUnknown};
  auto again = school(ship, {-200, 250, 0}, {-1, 0, 0});
  add_movement(again, ShipWay(ship), {}, &unknown);
  EXPECT_NEAR(again[10].speed_away_water_mps, 0.6, 1e-3);
  EXPECT_TRUE(std::isnan(again[10].speed_away_water_se_mps));
  EXPECT_TRUE(std::isnan(again[10].speed_water_smoothed_se_mps));
  EXPECT_TRUE(std::isnan(again[10].course_water_smoothed_se_deg));
}

}  // namespace
}  // namespace sonar
