// SPDX-License-Identifier: Apache-2.0
#include "school/settle_members.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "school/detect.h"
#include "school/mask_shape.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{20, 25, 900};

/// A school 200 m away whose density falls off by so many dB from its heart to its rim, evenly in dB.
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

double apparent_volume_ratio(double fall_db, const DetectParams& params) {
  const Sector sector = test::grid().sector(test::range_axis(kShape.samples));
  const Array3<SampleFlags> flags = test::cropped_flags(kShape, sector);
  const Array3<double> expected = peaked_school(sector, fall_db);
  const double truth = shape_of(test::truth_of(expected), sector).volume_m3;
  const test::FlatBackground flat(kShape);
  double found = 0.0;
  constexpr int kPings = 5;
  for (int ping = 1; ping <= kPings; ++ping) {
    const Array3<std::int16_t> counts = test::counts_of(expected, static_cast<std::uint64_t>(ping));
    const Array3<std::int16_t> sv = test::filtered(counts, flags);
    const auto schools =
        detect(sv.view(), counts.view(), flags.view(), sector, {flat.power_db, flat.calibration.view()}, params);
    EXPECT_EQ(schools.size(), 1U);
    if (!schools.empty()) found += schools.front().volume_m3 / kPings;
  }
  return found / truth;
}

TEST(SettleMembers, APeakedSchoolIsNoLargerThanItsTruth) {
  EXPECT_NEAR(apparent_volume_ratio(15.0, {}), 1.0, 0.2);
  // Counted down from what most of its voxels show, it would be.
  DetectParams most;
  most.peak_percentile = 0.0;
  EXPECT_GT(apparent_volume_ratio(15.0, most), 1.22);
}

TEST(SettleMembers, AnEvenSchoolIsNoSmallerThanItsTruth) { EXPECT_NEAR(apparent_volume_ratio(0.0, {}), 1.0, 0.05); }

}  // namespace
}  // namespace sonar
