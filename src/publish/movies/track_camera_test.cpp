// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/track_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

/// `count` pings 30 m apart on a bearing.
std::vector<PingNavigation> track(int count, double bearing_deg, double heading_deg) {
  std::vector<PingNavigation> pings(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    PingNavigation& ping = pings[static_cast<std::size_t>(i)];
    ping.transducer = destination({60.0, 5.0}, 30.0 * i, bearing_deg);
    ping.heading_deg = heading_deg + (i % 2 == 0 ? 3.0 : -3.0);  // the ship yaws
    ping.transducer_depth_m = 7.0 + 0.5 * (i % 3);
  }
  return pings;
}

const Camera kCamera{{400.0, -700.0, -300.0}, {0.0, -200.0, 50.0}, {0.0, 0.0, -1.0}, 0.6};

/// Where on the earth a place of the sonar frame is: m east, north, and depth below the sea's surface.
Point<Enu> earth_place(const Point<Sonar>& place, const PingNavigation& ship) {
  const Geographic there = to_geographic(to_enu(place, rad_from_deg(ship.heading_deg)), ship.transducer);
  Point<Enu> out = to_enu(there, {60.0, 5.0});
  out.z = place.z + ship.transducer_depth_m;
  return out;
}

TEST(TrackCamera, OfAShortTrackStaysWhereItIsOnTheEarth) {
  const auto pings = track(11, 40.0, 40.0);
  const auto camera = TrackCamera::along(pings, kCamera, 500.0);
  ASSERT_TRUE(camera);
  const Point<Enu> eye = earth_place(camera->seen_from(pings[0], 0.0).eye, pings[0]);
  const Point<Enu> target = earth_place(camera->seen_from(pings[0], 0.0).target, pings[0]);
  for (std::size_t i = 1; i < pings.size(); ++i) {
    const Camera now = camera->seen_from(pings[i], static_cast<double>(i));
    EXPECT_LT(norm(earth_place(now.eye, pings[i]) - eye), 0.05) << i;
    EXPECT_LT(norm(earth_place(now.target, pings[i]) - target), 0.05) << i;
  }
}

TEST(TrackCamera, OfALongTrackMovesEvenlyAndKeepsTheShipWithinItsReach) {
  const auto pings = track(101, 200.0, 200.0);  // 3000 m
  const auto camera = TrackCamera::along(pings, kCamera, 500.0);
  ASSERT_TRUE(camera);
  const double step = norm(camera->middle(1.0) - camera->middle(0.0));
  EXPECT_NEAR(step, 20.0, 0.1) << "2000 of 3000 m in 100 steps";
  for (std::size_t i = 0; i + 1 < pings.size(); ++i) {
    const auto at = static_cast<double>(i);
    EXPECT_NEAR(norm(camera->middle(at + 1.0) - camera->middle(at)), step, 1e-6);
    EXPECT_LT(norm(to_enu(pings[i].transducer, pings[50].transducer) - camera->middle(at)), 505.0);
  }
}

TEST(TrackCamera, OneThatStandsStaysHoweverLongTheTrackIs) {
  const auto pings = track(101, 200.0, 200.0);  // 3000 m
  const auto camera = TrackCamera::standing(pings, kCamera, pings[20]);
  ASSERT_TRUE(camera);
  EXPECT_LT(norm(camera->seen_from(pings[20], 20.0).eye - kCamera.eye), 1e-6);
  const Point<Enu> eye = earth_place(kCamera.eye, pings[20]);
  for (std::size_t i = 0; i < pings.size(); ++i) {
    const Camera now = camera->seen_from(pings[i], static_cast<double>(i));
    EXPECT_LT(norm(earth_place(now.eye, pings[i]) - eye), 0.05) << i;
  }
}

TEST(TrackCamera, FromFartherItLooksAtTheSamePlace) {
  const auto pings = track(11, 90.0, 90.0);
  const auto camera = TrackCamera::along(pings, kCamera, 300.0);
  ASSERT_TRUE(camera);
  const Camera near = camera->seen_from(pings[5], 5.0);
  const Camera far = camera->from_farther(1.5).seen_from(pings[5], 5.0);
  EXPECT_LT(norm(far.target - near.target), 1e-9);
  EXPECT_NEAR(norm(far.eye - far.target), 1.5 * norm(kCamera.eye - kCamera.target), 1e-6);
}

TEST(TrackCamera, WhatIsNotKnownIsOneLine) {
  auto pings = track(3, 0.0, 0.0);
  pings[1].heading_deg = std::nan("");
  const auto no_heading = TrackCamera::along(pings, kCamera, 500.0);
  ASSERT_FALSE(no_heading);
  EXPECT_NE(no_heading.error().text.find("has no heading"), std::string::npos);
  pings[1].transducer.latitude_deg = std::nan("");
  EXPECT_NE(TrackCamera::along(pings, kCamera, 500.0).error().text.find("has no position"), std::string::npos);
  EXPECT_EQ(TrackCamera::along(std::span(pings).first(1), kCamera, 500.0).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace sonar
