// SPDX-License-Identifier: Apache-2.0
#include "school/measure/movement.h"

#include <gtest/gtest.h>

#include <cmath>
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

}  // namespace
}  // namespace sonar
