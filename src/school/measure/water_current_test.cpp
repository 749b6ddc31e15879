// SPDX-License-Identifier: Apache-2.0
#include "school/measure/water_current.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/measure/summarise.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr TimeNs kStart = 1'600'000'000 * kSecondNs;
constexpr Geographic kHere{60, 4};

CurrentProfile profile(double after_s, std::vector<CurrentAt> bins, const Geographic& place = kHere) {
  return {kStart + static_cast<TimeNs>(after_s * 1e9), place, std::move(bins)};
}

// By hand: half way between 10 and 30 m; the first bin above, the last below, none more than 20 m off.
TEST(CurrentIn, IsLinearInDepthAndHoldsBeyond) {
  const CurrentProfile one = profile(0, {{10, 0.2, 0.0}, {30, 0.4, -0.2}});
  constexpr double kGap_m = 20.0;
  EXPECT_NEAR(current_in(one, 20, kGap_m)->east_mps, 0.3, 1e-12);
  EXPECT_NEAR(current_in(one, 20, kGap_m)->north_mps, -0.1, 1e-12);
  EXPECT_NEAR(current_in(one, 15, kGap_m)->east_mps, 0.25, 1e-12);
  EXPECT_NEAR(current_in(one, 2, kGap_m)->east_mps, 0.2, 1e-12);
  EXPECT_NEAR(current_in(one, 49, kGap_m)->east_mps, 0.4, 1e-12);
  EXPECT_FALSE(current_in(one, 51, kGap_m));
  EXPECT_FALSE(current_in(profile(0, {}), 20, kGap_m));
}

// By hand: a quarter of the way from 0.1 to 0.5 m/s.
TEST(CurrentAt, IsLinearInTime) {
  const CurrentProfiles two{profile(0, {{20, 0.1, 0.0}}), profile(400, {{20, 0.5, 0.0}})};
  const auto found = current_at(two, kStart + 100 * kSecondNs, kHere, 20, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->east_mps, 0.2, 1e-12);
  EXPECT_NEAR(found->share_of_after, 0.25, 1e-12);
  EXPECT_NEAR(current_at(two, kStart - 100 * kSecondNs, kHere, 20, {})->east_mps, 0.1, 1e-12) << "held before";
  EXPECT_NEAR(current_at(two, kStart + 1000 * kSecondNs, kHere, 20, {})->east_mps, 0.5, 1e-12) << "held after";
  EXPECT_FALSE(current_at(two, kStart + 2000 * kSecondNs, kHere, 20, {})) << "farther than max_gap_s";
}

TEST(CurrentAt, TakesNoProfileFromFarAwayNorOneThatDoesNotReach) {
  const Geographic far{60.1, 4};  // 11 km
  const CurrentProfiles mixed{profile(0, {{20, 0.1, 0.0}}), profile(100, {{20, 9.0, 0.0}}, far),
                              profile(200, {{200, 9.0, 0.0}}), profile(400, {{20, 0.5, 0.0}})};
  EXPECT_NEAR(current_at(mixed, kStart + 150 * kSecondNs, kHere, 20, {})->east_mps, 0.25, 1e-12);
  CurrentProfiles placeless{profile(0, {{20, 0.1, 0.0}}, CurrentProfile{}.place)};
  EXPECT_TRUE(current_at(placeless, kStart, kHere, 20, {})) << "a profile without a place holds everywhere";
}

// 200 profiles of 20 bins, noise 0.05 m/s each way on a current that rises evenly, which is no noise.
TEST(CurrentNoise, IsWhatWasPutIn) {
  CurrentProfiles profiles;
  for (std::uint64_t i = 0; i < 200; ++i) {
    CurrentProfile one = profile(120.0 * static_cast<double>(i), {});
    for (std::uint64_t k = 0; k < 20; ++k) {
      const std::uint64_t seed = 2 * (i * 100 + k);
      const double rising = 0.002 * static_cast<double>(i);
      one.bins.push_back(
          {10.0 + 8.0 * static_cast<double>(k), rising + 0.05 * test::normal(seed), 0.05 * test::normal(seed + 1)});
    }
    profiles.push_back(one);
  }
  EXPECT_NEAR(current_noise_mps(profiles, {}), 0.05, 0.002);
  profiles.resize(2);
  EXPECT_TRUE(std::isnan(current_noise_mps(profiles, {})));
}

/// A school that swims (east, north) m/s through water that moves as given, a ping every 5 s.
std::vector<SchoolPingRow> carried(int pings, Point<Enu> swims, const CurrentProfiles& water, double depth_m) {
  std::vector<SchoolPingRow> rows;
  Point<Enu> at;
  for (int i = 0; i < pings; ++i) {
    SchoolPingRow row;
    row.ping_index = i;
    row.time_utc = kStart + i * 5 * kSecondNs;
    const Geographic place = to_geographic(at, kHere);
    row.latitude = place.latitude_deg;
    row.longitude = place.longitude_deg;
    row.depth_m = depth_m;
    rows.push_back(row);
    // Between two profiles the velocity changes linearly: that in the middle of a step is its mean.
    const auto current = current_at(water, row.time_utc + 5 * kSecondNs / 2, place, depth_m, {});
    at = at + (swims + Point<Enu>{current->east_mps, current->north_mps, 0.0}) * 5.0;
  }
  return rows;
}

// Put in: 0.3 m/s east, 0.4 m/s north through water that turns and speeds up. Against the ground the school does otherwise.
TEST(ThroughWater, ACarriedSchoolGivesBackWhatWasPutIn) {
  const CurrentProfiles water{profile(-10, {{20, 0.1, 0.5}, {60, 0.3, 0.1}}),
                              profile(100, {{20, 0.3, -0.5}, {60, 0.5, -0.7}}),
                              profile(250, {{20, 0.6, -0.3}, {60, 0.8, -0.5}})};
  const auto rows = carried(40, {0.3, 0.4, 0.0}, water, 40.0);
  const WaterCurrents currents{&water, {}, 0.02};
  const SchoolRow row = summarise(rows, {}, &currents);
  EXPECT_NEAR(row.speed_water_mps, 0.5, 2e-3);
  EXPECT_NEAR(row.course_water_deg, deg_from_rad(std::atan2(0.3, 0.4)), 0.3);
  EXPECT_GT(std::abs(row.speed_mps - row.speed_water_mps), 0.15) << "over ground it is another";
  EXPECT_TRUE(std::isnan(summarise(rows, {}).speed_water_mps)) << "no current";
}

// One profile for all: the noise of its velocity is that of the speed. By hand: 0.05.
TEST(ThroughWater, TheProfilesNoiseIsTheSpeedsError) {
  const CurrentProfiles water{profile(60, {{40, 0.2, -0.1}})};
  const auto rows = carried(30, {0.6, 0.8, 0.0}, water, 40.0);
  const WaterCurrents currents{&water, {}, 0.05};
  const SchoolRow row = summarise(rows, {}, &currents);
  EXPECT_NEAR(row.current_se_mps, 0.05, 1e-9);
  EXPECT_NEAR(row.speed_water_se_mps, 0.05, 1e-3);
  EXPECT_NEAR(row.course_water_se_deg, deg_from_rad(0.05), 0.1);
  const WaterCurrents unknown{&water, {}, kUnknown};
  const SchoolRow unsure = summarise(rows, {}, &unknown);
  EXPECT_NEAR(unsure.speed_water_mps, 1.0, 2e-3);
  EXPECT_TRUE(std::isnan(unsure.speed_water_se_mps));
  EXPECT_TRUE(std::isnan(unsure.course_water_deg));
}

}  // namespace
}  // namespace sonar
