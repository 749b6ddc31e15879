// SPDX-License-Identifier: Apache-2.0
#include "school/judge/ship.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "model/school.h"

namespace sonar {
namespace {

struct Passage {
  double ship_mps = 3.1;
  Point<Sonar> drift_mps{};  ///< of the echo, as the ship sees it
  std::int32_t edges = kEdgeBottomFan;
  double turn_deg = 0.0;  ///< of the ship, each ping
};

bool stays(const Passage& passage, int pings = 5, const ShipParams& params = {}) {
  std::vector<DetectedPing> detected;
  std::vector<TrackedDetection> tracked;
  Geographic place{60.0, 179.9999};
  for (int p = 0; p < pings; ++p) {
    DetectedPing ping;
    ping.ping_index = 10 + p;
    ping.time = p * 5 * kSecondNs;
    ping.placement.transducer = place;
    ping.placement.heading_rad = rad_from_deg(passage.turn_deg * p);
    Detection detection;
    detection.centre = Point<Sonar>{10.0, -200.0, 200.0} + passage.drift_mps * (5.0 * p);
    detection.edge_flags = passage.edges;
    ping.detections = {{}, detection};
    tracked.push_back({ping.ping_index, {1}, {}});
    const double way_m = 5.0 * passage.ship_mps;
    const double heading = ping.placement.heading_rad;
    place = to_geographic(Point<Enu>{way_m * std::sin(heading), way_m * std::cos(heading), 0.0}, place);
    detected.push_back(std::move(ping));
  }
  return judge_ship({tracked, detected}, params).has_value();
}

TEST(JudgeShip, TheSeabedInTheLowestFanDoes) {
  EXPECT_TRUE(stays({}));
  EXPECT_TRUE(stays({.drift_mps = {0.2, 0.3, 0.0}})) << "its middle wanders a little";
  EXPECT_TRUE(stays({.drift_mps = {0.0, 0.0, 0.5}})) << "the seabed sinks";
  EXPECT_TRUE(stays({.turn_deg = 1.0})) << "and it turns with the ship";
  EXPECT_TRUE(stays({.edges = 0})) << "side lobes hear what lies under the ship";
}

// 2 knots, as beside a school or before a trawl: what keeps its place to a few centimetres a second over 22 m of way is
// hardly a school. exp(-1.1^2 / 2) 0.1^2 / 2 = 0.003 of them swim so, and 0.02 as the other one.
TEST(JudgeShip, ASlowShipsCloudsDo) {
  EXPECT_TRUE(stays({.ship_mps = 1.1, .drift_mps = {0.1, 0.0, 0.0}}));
  EXPECT_FALSE(stays({.ship_mps = 1.1, .drift_mps = {-0.27, 0.0, 0.0}})) << "a school that swims along";
  EXPECT_FALSE(stays({.ship_mps = 1.1}, 4)) << "16 m of way";
  EXPECT_FALSE(stays({.ship_mps = 0.4}, 40)) << "a ship that drifts, as fish do";
}

// The sector's edge cuts a cloud: then the ship's way tells, where it is longer than a school.
TEST(JudgeShip, WhatTheSectorCutsDoesAfterALongWay) {
  EXPECT_FALSE(stays({.edges = kEdgeAft}, 13)) << "186 m of way";
  EXPECT_TRUE(stays({.edges = kEdgeAft}, 15)) << "217 m of way";
}

TEST(JudgeShip, ATurningShipsCloudsDo) {
  for (const int pings : {12, 40}) EXPECT_TRUE(stays({.turn_deg = 4.44}, pings)) << pings;
}

TEST(JudgeShip, WhatIsPassedDoesNot) {
  EXPECT_FALSE(stays({.drift_mps = {-3.1, 0.0, 0.0}})) << "at rest";
  EXPECT_FALSE(stays({.drift_mps = {-1.1, 0.0, 0.0}})) << "swims 2 m/s with the ship";
}

TEST(JudgeShip, ASchoolThatTheShipCirclesDoesNot) {
  // 15.5 m a ping on a circle of 200 m round it: 4.44 degrees to port, where it stays abeam.
  for (const int pings : {3, 5, 10, 40}) EXPECT_FALSE(stays({.turn_deg = -4.44}, pings)) << pings;
}

TEST(JudgeShip, WhatTellsNothingIsLeftAlone) {
  EXPECT_FALSE(stays({.edges = kEdgeBottomFan | kEdgeFore})) << "one longer than the sector is wide seems to stay";
  EXPECT_FALSE(stays({}, 2)) << "two pings give no drift that could be doubted";
  ShipParams off;
  off.drift_share = 0.0;
  EXPECT_FALSE(stays({}, 5, off));
}

}  // namespace
}  // namespace sonar
