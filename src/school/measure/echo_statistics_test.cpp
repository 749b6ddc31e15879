// SPDX-License-Identifier: Apache-2.0
#include "school/measure/echo_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

/// A school of 20 m at 120 m with a faulty beam through it.
class Echoes : public testing::Test {
 protected:
  Echoes() {
    ping_.add(test::ellipsoid(120.0, -20.0, 270.0));
    const sonar::Run& faulty = ping_.mask.runs[ping_.mask.runs.size() / 2];
    for (int s = faulty.first_sample; s < faulty.end(); s += 2)
      ping_.flags(row(faulty), beam(faulty), s) |= SampleFlags::impulse;
    measured_ = ping_.measured(7);
  }
  static int row(const sonar::Run& run) { return run.row / 25; }
  static int beam(const sonar::Run& run) { return run.row % 25; }
  MeasureInput input() {
    MeasureInput in;
    in.sv = ping_.counts.view();
    in.flags = ping_.flags.view();
    in.sector = &ping_.sector;
    in.background = {ping_.flat.power_db, ping_.flat.calibration.view()};
    return in;
  }

  test::MeasuredPing ping_;
  SchoolPingRow measured_;
};

TEST_F(Echoes, SayWhatTheSchoolsOwnRowSays) {
  const EchoStatistics echo = echo_statistics(input(), ping_.mask);
  EXPECT_EQ(echo.voxels, measured_.n_voxels);
  EXPECT_LT(echo.heard, echo.voxels) << "some are faulty";
  EXPECT_EQ(echo.sv_mean_db, measured_.sv_mean_db);
  EXPECT_EQ(echo.sv_p95_db, measured_.sv_p95_db);
  EXPECT_EQ(echo.sv_max_db, measured_.sv_max_db);
  EXPECT_EQ(echo.snr_db, measured_.snr_db);
  EXPECT_EQ(echo.heard_m3 / echo.volume_m3, measured_.valid_fraction);
  EXPECT_NEAR(echo.volume_m3 / measured_.volume_m3, 1.0, 1e-12);  // summed in another order
  EXPECT_NEAR(echo.backscatter_m2 / measured_.backscatter_m2, 1.0, 1e-12);
  const MaskExtents extents =
      mask_extents(ping_.mask, shape_of(ping_.mask, ping_.sector).covariance, ping_.sector, ping_.placement);
  EXPECT_EQ(extents.depth_min_m, measured_.depth_min_m);
  EXPECT_EQ(extents.depth_max_m, measured_.depth_max_m);
  EXPECT_EQ(extents.length_m, measured_.length_m);
  EXPECT_EQ(extents.axis_deg, measured_.axis_deg);
}

// Voxel by voxel: cells by the shells' own formula, levels by a full sort.
TEST_F(Echoes, AreThoseOfAPlainLoop) {
  std::vector<double> values;
  double sum = 0.0;
  double heard_m3 = 0.0;
  double volume_m3 = 0.0;
  double nearest = 1e9;
  double farthest = 0.0;
  const double half = 0.5 * 0.3776;
  for (const sonar::Run& run : ping_.mask.runs) {
    const AngleBounds e = ping_.sector.elevation_bounds(row(run));
    const AngleBounds a = ping_.sector.azimuth_bounds(beam(run));
    const double sr = (a.upper - a.lower) * (std::sin(e.upper) - std::sin(e.lower));
    for (int s = run.first_sample; s < run.end(); ++s) {
      const double r = -0.75 + 0.3776 * s;
      nearest = std::min(nearest, r - half);
      farthest = std::max(farthest, r + half);
      const double cell = sr * (std::pow(r + half, 3) - std::pow(r - half, 3)) / 3.0;
      volume_m3 += cell;
      if (any(ping_.flags(row(run), beam(run), s) & kFault)) continue;
      const double noise = std::pow(10.0, (ping_.flat.power_db[static_cast<std::size_t>(run.row)] +
                                           ping_.flat.calibration(row(run), beam(run), s) * kDbPerCount) /
                                              10.0);
      const double sv = std::pow(10.0, ping_.counts(row(run), beam(run), s) * kDbPerCount / 10.0) - noise;
      values.push_back(sv);
      sum += sv * cell;
      heard_m3 += cell;
    }
  }
  const EchoStatistics echo = echo_statistics(input(), ping_.mask);
  EXPECT_EQ(echo.heard, static_cast<std::int64_t>(values.size()));
  EXPECT_NEAR(echo.volume_m3 / volume_m3, 1.0, 1e-9);
  EXPECT_NEAR(echo.sv_mean_db, 10.0 * std::log10(sum / heard_m3), 1e-6);
  EXPECT_NEAR(echo.backscatter_m2 / (sum / heard_m3 * volume_m3), 1.0, 1e-6);
  std::sort(values.begin(), values.end());
  const auto level = [&](double share) {
    const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
    return values[at] > 0.0 ? 10.0 * std::log10(values[at]) : kUnknown;
  };
  ASSERT_GT(level(0.05), -200.0) << "the school is louder than the noise throughout";
  EXPECT_NEAR(echo.sv_p5_db, level(0.05), 1e-6);
  EXPECT_NEAR(echo.sv_p50_db, level(0.50), 1e-6);
  EXPECT_NEAR(echo.sv_p95_db, level(0.95), 1e-6);
  EXPECT_NEAR(echo.sv_max_db, level(1.0), 1e-6);
  const MaskExtents extents =
      mask_extents(ping_.mask, shape_of(ping_.mask, ping_.sector).covariance, ping_.sector, ping_.placement);
  EXPECT_NEAR(extents.range_min_m, nearest, 1e-9);
  EXPECT_NEAR(extents.range_max_m, farthest, 1e-9);
}

TEST_F(Echoes, OfOneVoxelAllLevelsAreItsOwnAndOfNoneNothingIsKnown) {
  // In the middle of the school, where no voxel was made faulty.
  const sonar::Run& loud = ping_.mask.runs[ping_.mask.runs.size() / 2 + 1];
  PingMask one;
  one.runs = {{loud.row, loud.first_sample + loud.count / 2, 1}};
  one.confidence = {255};
  const EchoStatistics echo = echo_statistics(input(), one);
  EXPECT_EQ(echo.heard, 1);
  EXPECT_EQ(echo.sv_max_db, echo.sv_p95_db);
  ASSERT_GT(echo.mean_sv_per_m, 0.0);
  EXPECT_EQ(echo.sv_p5_db, echo.sv_max_db);
  EXPECT_NEAR(echo.sv_mean_db, echo.sv_max_db, 1e-12);
  const EchoStatistics none = echo_statistics(input(), {});
  EXPECT_EQ(none.voxels, 0);
  EXPECT_EQ(none.volume_m3, 0.0);
  EXPECT_TRUE(std::isnan(none.sv_mean_db) && std::isnan(none.backscatter_m2) && std::isnan(none.sv_max_db));
}

}  // namespace
}  // namespace sonar
