// SPDX-License-Identifier: Apache-2.0
#include "school/measure/school_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "base/units.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

double error_of(const FigureValues& errors, std::string_view figure) {
  for (std::size_t i = 0; i < kErrorCount; ++i) {
    if (kErrorColumns[i].figure == figure) return errors[i];
  }
  return kUnknown;
}

std::size_t backscatter_at() {
  std::size_t i = 0;
  while (kErrorColumns[i].figure != "backscatter_m2") ++i;
  return i;
}

SchoolPingRow row_of(double volume_m3) {
  SchoolPingRow row;
  row.volume_m3 = volume_m3;
  row.length_m = 40.0;
  row.depth_m = 60.0;
  row.sv_mean_db = -45.0;
  row.backscatter_m2 = 0.5;
  row.horizontal_range_m = 200.0;
  return row;
}

Repeats unchanged(const SchoolPingRow& row) {
  const FigureValues figures = figures_of(row);
  Repeats repeats(kFadings + 2);
  for (auto& one : repeats) {
    for (std::size_t i = 0; i < kErrorCount; ++i) one[i] = static_cast<float>(figures[i]);
  }
  return repeats;
}

// By hand: 0.5 % of sound speed is 1.5 % of a volume; 200 m x 0.5 degrees are 1.745 m of depth.
TEST(SchoolErrors, WhatIsAlikeInAllPingsIsNotMadeSmallerByThem) {
  for (const std::size_t pings : {std::size_t{1}, std::size_t{9}}) {
    const std::vector<SchoolPingRow> rows(pings, row_of(1000.0));
    const Repeats one = unchanged(rows.front());
    const std::vector<const Repeats*> repeats(pings, &one);
    const FigureValues errors = school_errors(rows, repeats, {}, {});
    EXPECT_NEAR(error_of(errors, "volume_m3"), 15.0, 1e-3);
    EXPECT_NEAR(error_of(errors, "length_m"), 0.2, 1e-5);
    EXPECT_NEAR(error_of(errors, "sv_mean_db"), std::hypot(0.5, 10.0 * std::log10(1.005)), 1e-5);
    EXPECT_NEAR(error_of(errors, "depth_m"), std::hypot(0.3, 200.0 * 0.5 * std::numbers::pi / 180.0), 1e-4);
    EXPECT_TRUE(std::isnan(error_of(errors, "surface_m2"))) << "a figure that is unknown has no error";
  }
}

// Deviations +-1 in turn: 16 of them have the deviation sqrt(16 / 15); widened for their number. The threshold adds half of 6.
TEST(SchoolErrors, FadingAndThresholdAddInQuadrature) {
  const std::vector<SchoolPingRow> rows{row_of(1000.0)};
  Repeats one = unchanged(rows.front());
  for (std::size_t k = 0; k < one.size(); ++k) one[k][1] += k % 2 == 0 ? 1.0F : -1.0F;
  one[kFadings][1] = 1003.0F;
  one[kFadings + 1][1] = 997.0F;
  const std::vector<const Repeats*> repeats{&one};
  ErrorParams params;
  params.sound_speed_percent = 0.0;
  const double fading = std::sqrt(16.0 / 15.0) * 2.1314 / 1.95996;
  EXPECT_NEAR(error_of(school_errors(rows, repeats, {}, params), "volume_m3"), std::hypot(fading, 3.0), 1e-3);
  const Repeats none;
  const std::vector<const Repeats*> unknown{&none};
  EXPECT_TRUE(std::isnan(error_of(school_errors(rows, unknown, {}, params), "volume_m3")))
      << "it was not measured again";
}

// Four pings with four fadings each, -3, -1, 1 and 3 off: the variance of one is 20 / 3, that of their mean a quarter of it.
// The 16 ways to put them together know it about as well as 8 independent ones.
TEST(SchoolErrors, PingsShareOutTheFadings) {
  EXPECT_EQ(fadings_of_ping(1), 16);
  EXPECT_EQ(fadings_of_ping(2), 8);
  EXPECT_EQ(fadings_of_ping(40), 4);
  double variance = 0.0;
  constexpr int kSchools = 30;
  for (int school = 0; school < kSchools; ++school) {
    std::vector<SchoolPingRow> rows(4, row_of(1000.0));
    std::vector<Repeats> repeats(4, Repeats(6, unchanged(rows.front()).front()));
    for (std::size_t ping = 0; ping < 4; ++ping) {
      for (std::size_t k = 0; k < 4; ++k) {
        // whichever order they were drawn in
        const auto turn = (k + static_cast<std::size_t>(school) * (ping + 1)) % 4;
        repeats[ping][k][0] += -3.0F + 2.0F * static_cast<float>(school % 2 == 0 ? turn : 3 - turn);
      }
    }
    std::vector<const Repeats*> all;
    for (const Repeats& one : repeats) all.push_back(&one);
    ErrorParams params;
    params.sound_speed_percent = params.tilt_deg = 0.0;
    variance += std::pow(error_of(school_errors(rows, all, {}, params), "depth_m"), 2) / kSchools;
  }
  EXPECT_NEAR(variance / (20.0 / 3.0 / 4.0) / std::pow(2.1314 / 1.95996, 2), 1.0, 0.35);
}

// A school hardly larger than the median's box: what it is measured as again is as loud as it was heard. Its filtered level
// alone is 2.5 dB lower than that.
TEST(SchoolErrors, RepeatsHoldAsMuchEchoAsTheSchool) {
  test::MeasuredPing scene;
  test::Ellipsoid body;
  body.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 180.0;
  scene.add(body);
  const SchoolPingRow row = scene.measured(1);
  MeasureInput in;
  in.sv = scene.counts.view();
  in.filtered = scene.filtered.view();
  in.flags = scene.flags.view();
  in.sector = &scene.sector;
  in.grid = &scene.grid;
  in.background = {scene.flat.power_db, scene.flat.calibration.view()};
  in.placement = scene.placement;
  in.threshold_db = -200.0;  // the mask stays as it is
  ErrorParams params;
  params.enabled = true;
  const Repeats repeats = measure_repeats(in, scene.mask, {}, 10.0, 7, 1, {}, params);
  ASSERT_EQ(repeats.size(), static_cast<std::size_t>(kFadings + 2));
  double mean = 0.0;
  for (std::size_t k = 0; k < kFadings; ++k) mean += static_cast<double>(repeats[k][backscatter_at()]) / kFadings;
  EXPECT_NEAR(mean / row.backscatter_m2, 1.0, 0.15) << "of 16 repeats that scatter by 0.15 each";
}

}  // namespace
}  // namespace sonar
