// SPDX-License-Identifier: Apache-2.0
#include "school/detect/settle_members.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "school/detect/detect.h"
#include "school/mask_shape.h"
#include "school/test_scene.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 900};

/// A school 200 m away whose density falls off by so many dB from its core to its margin, evenly in dB.
Array3<double> peaked_school(const Sector& sector, double fall_db) {
  Array3<double> expected(kShape);
  constexpr int kShells = 8;
  double sum = 0.0;
  for (int shell = kShells; shell > 0; --shell) {
    const double size = static_cast<double>(shell) / kShells;
    const double level = linear_from_db(-40.0 - fall_db * size);
    test::Ellipsoid e;
    e.centre = Sector::direction(rad_from_deg(-20.0), rad_from_deg(270.0)) * 200.0;
    e.half_x = 24.0 * size;
    e.half_y = 18.0 * size;
    e.half_z = 12.0 * size;
    e.sv = level - sum;
    sum = level;
    test::add_ellipsoid(expected, sector, e);
  }
  return expected;
}

double apparent_volume_ratio(double fall_db, test::Scene scene = test::Scene()) {
  scene.expected = peaked_school(scene.sector, fall_db);
  const double truth = shape_of(test::truth_of(scene.expected), scene.sector).volume_m3;
  double found = 0.0;
  constexpr int kPings = 5;
  for (int ping = 1; ping <= kPings; ++ping) {
    const auto schools = scene.look(static_cast<std::uint64_t>(ping));
    EXPECT_EQ(schools.size(), 1U);
    if (!schools.empty()) found += schools.front().volume_m3 / kPings;
  }
  return found / truth;
}

TEST(SettleMembers, APeakedSchoolIsNoLargerThanItsTruth) {
  EXPECT_NEAR(apparent_volume_ratio(15.0), 1.0, 0.2);
  // Counted down from what most of its voxels show, it would be.
  test::Scene most;
  most.peaked = false;
  EXPECT_GT(apparent_volume_ratio(15.0, most), 1.22);
}

TEST(SettleMembers, AnEvenSchoolIsNoSmallerThanItsTruth) { EXPECT_NEAR(apparent_volume_ratio(0.0), 1.0, 0.05); }

// Where beams are separate the filter looks along each alone: its loudest voxels are fading, 3 dB above the school.
TEST(SettleMembers, ThePeakOfOneBeamsFilterIsNotTheSchools) {
  test::Scene one_beam;
  one_beam.box = {.kernel_fans = 1, .kernel_beams = 1};
  EXPECT_LT(apparent_volume_ratio(0.0, one_beam), 0.9);
  one_beam.peaked = false;
  EXPECT_NEAR(apparent_volume_ratio(0.0, one_beam), 1.0, 0.07);
}

/// One detection for each of the scene's schools, which holds it and little else.
void expect_schools_apart(const std::vector<Detection>& found, const test::Scene& scene, double least_dice) {
  ASSERT_EQ(found.size(), scene.truths.size());
  for (const PingMask& truth : scene.truths) {
    double best = 0.0;
    for (const Detection& school : found) best = std::max(best, dice(school.mask, truth));
    EXPECT_GT(best, least_dice);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(overlap(found[i].mask, found[j].mask), 0U);
  }
}

// The filter's box of three beams bridges the 26 m of open water between two schools 48 m apart. Bodies that touch stay one.
TEST(SettleMembers, OpenWaterPartsSchoolsThatTheFilterJoins) {
  test::Scene apart;
  apart.add(240.0, -18.0, 261.0, -36.0, {11, 9, 6});
  apart.add(240.0, -18.0, 273.0, -36.0, {11, 9, 6});
  expect_schools_apart(apart.look(31), apart, 0.85);
  test::Scene touching;
  touching.add(240.0, -18.0, 263.5, -36.0, {11, 9, 6});
  touching.add(240.0, -18.0, 268.5, -36.0, {11, 9, 6});
  EXPECT_EQ(touching.look(32).size(), 1U);
}

// One fan between two schools is free: the filter's box of three fans fills it. Their echo, spread by the beams, is still
// within 10 dB of their tops there.
TEST(SettleMembers, OneFreeFanPartsSchoolsOneAboveTheOther) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Scene scene;
    scene.add(200.0, -31.0, 270.0, -38.0, {12, 12, 4});
    scene.add(200.0, -18.0, 270.0, -38.0, {12, 12, 4});
    expect_schools_apart(scene.look(seed), scene, 0.8);
  }
}

// A school 6 dB fainter than its neighbour is as large as if it were alone: down to 10 dB below its own top.
TEST(SettleMembers, AFaintSchoolKeepsItsMarginBesideALoudOne) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Scene scene;
    scene.add(200.0, -32.0, 270.0, -38.0, {12, 12, 4});
    scene.add(200.0, -18.0, 270.0, -44.0, {12, 12, 4});
    expect_schools_apart(scene.look(seed), scene, 0.8);
  }
}

// Lumps 6 dB above the rest of a school are no schools of their own.
TEST(SettleMembers, ALumpySchoolStaysOne) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Scene scene;
    scene.add(200.0, -22.0, 270.0, -44.0, {45, 25, 22});
    for (const double azimuth_deg : {263.0, 277.0}) {
      for (const double elevation_deg : {-26.0, -18.0}) {
        scene.add(200.0, elevation_deg, azimuth_deg, -45.0, {8, 8, 5});
      }
    }
    EXPECT_EQ(scene.look(seed).size(), 1U) << seed;
  }
}

}  // namespace
}  // namespace sonar
