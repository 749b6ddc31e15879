// SPDX-License-Identifier: Apache-2.0
#include "school/track/dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
const Geographic kStart{60.0, 4.0};

/// A ship on a straight course, a ping every 5 s.
std::vector<PingNavigation> voyage(int pings, double speed_mps, double course_deg) {
  std::vector<PingNavigation> all(static_cast<std::size_t>(pings));
  for (int i = 0; i < pings; ++i) {
    PingNavigation& at = all[static_cast<std::size_t>(i)];
    at.time = i * 5 * kSecondNs;
    const double way = speed_mps * 5.0 * i;
    const double course = rad_from_deg(course_deg);
    at.transducer = to_geographic(Point<Enu>{way * std::sin(course), way * std::cos(course), 0.0}, kStart);
    at.heading_deg = at.course_deg = course_deg;
    at.speed_mps = speed_mps;
    at.transducer_depth_m = 7.0;
  }
  return all;
}

void forget(PingNavigation& at) {
  at.transducer = {kUnknown, kUnknown};
  at.heading_deg = at.course_deg = at.speed_mps = kUnknown;
}

double apart_m(const Geographic& a, const Geographic& b) { return geodesic(a, b).distance_m; }

TEST(DeadReckoning, KnownPingsStayAsTheyAre) {
  const auto pings = voyage(6, 3.0, 40.0);
  const DeadReckoning reckoned = dead_reckoning(pings);
  EXPECT_EQ(reckoned.without_position, 0);
  EXPECT_EQ(reckoned.without_heading, 0);
  for (std::size_t i = 0; i < pings.size(); ++i) {
    EXPECT_EQ(reckoned.pings[i].transducer, pings[i].transducer);
    EXPECT_DOUBLE_EQ(reckoned.pings[i].heading_rad, rad_from_deg(40.0));
    EXPECT_EQ(reckoned.pings[i].transducer_depth_m, 7.0);
  }
}

// Law: a ship that keeps its speed and course is reckoned where it was, whichever pings say nothing: within a gap,
// before the first fix, after the last.
TEST(DeadReckoning, FindsASteadyShipAgain) {
  const auto truth = voyage(20, 3.0, 250.0);
  for (const auto& [first, last] : {std::pair(6, 13), std::pair(0, 8), std::pair(9, 19), std::pair(1, 18)}) {
    auto pings = truth;
    for (int i = first; i <= last; ++i) forget(pings[static_cast<std::size_t>(i)]);
    const DeadReckoning reckoned = dead_reckoning(pings);
    EXPECT_EQ(reckoned.without_position, last - first + 1);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_LT(apart_m(reckoned.pings[i].transducer, truth[i].transducer), 0.05) << first << " " << i;
      EXPECT_NEAR(reckoned.pings[i].heading_rad, rad_from_deg(250.0), 1e-9);
    }
  }
}

// By hand: 10 s at 3 m/s and 10 s at 1 m/s to the north, but the next fix lies 60 m away, not 40: of the 20 m too few,
// half are added half way in time.
TEST(DeadReckoning, SpreadsTheMisclosureByTime) {
  auto pings = voyage(3, 0.0, 0.0);
  pings[1].time = 10 * kSecondNs;
  pings[2].time = 20 * kSecondNs;
  pings[1].transducer = {kUnknown, kUnknown};
  pings[2].transducer = to_geographic(Point<Enu>{0.0, 60.0, 0.0}, kStart);
  pings[0].speed_mps = 4.0;
  pings[1].speed_mps = 2.0;
  pings[2].speed_mps = 0.0;
  const Placement middle = dead_reckoning(pings).pings[1];
  EXPECT_NEAR(to_enu(middle.transducer, kStart).y, 30.0 + 10.0, 1e-3);
}

// A log and a gyro without any fix still tell how pings lie to each other.
TEST(DeadReckoning, SailsByLogAndHeadingAlone) {
  auto pings = voyage(5, 3.0, 90.0);
  for (auto& at : pings) {
    at.transducer = {kUnknown, kUnknown};
    at.course_deg = kUnknown;
  }
  const DeadReckoning reckoned = dead_reckoning(pings);
  const Point<Enu> way = to_enu(reckoned.pings[4].transducer, reckoned.pings[0].transducer);
  EXPECT_NEAR(way.x, 60.0, 1e-3);
  EXPECT_NEAR(way.y, 0.0, 1e-3);
}

TEST(DeadReckoning, HeadingOverTheShorterArcElseTheCourse) {
  auto pings = voyage(3, 3.0, 0.0);
  pings[0].heading_deg = 350.0;
  pings[1].heading_deg = kUnknown;
  pings[2].heading_deg = 20.0;
  EXPECT_NEAR(dead_reckoning(pings).pings[1].heading_rad, rad_from_deg(5.0), 1e-9);
  EXPECT_EQ(dead_reckoning(pings).without_heading, 1);
  for (auto& at : pings) at.heading_deg = kUnknown;
  pings[1].course_deg = 33.0;
  EXPECT_NEAR(dead_reckoning(pings).pings[1].heading_rad, rad_from_deg(33.0), 1e-9);
  for (auto& at : pings) forget(at);
  EXPECT_EQ(dead_reckoning(pings).pings[1].heading_rad, 0.0);
  EXPECT_TRUE(dead_reckoning({}).pings.empty());
}

}  // namespace
}  // namespace sonar
