// SPDX-License-Identifier: Apache-2.0
#include "school/measure/total_echo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

constexpr double kWater_sv = 1e-7;

test::Ellipsoid school(double range_m, double elevation_deg, double azimuth_deg) {
  test::Ellipsoid e;
  e.centre = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
  e.half_x = 16.0;
  e.half_y = 11.0;
  e.half_z = 6.0;
  e.sv = 1e-4;
  return e;
}
double body_m2(const test::Ellipsoid& e) {
  return 4.0 / 3.0 * std::numbers::pi * e.half_x * e.half_y * e.half_z * e.sv;
}

void fill_with_water(test::MeasuredPing& ping) {
  for (double& sv : ping.expected.all()) sv += kWater_sv;
}

// A mask 10 dB below the top holds up to 0.9 dB less than the body's echo; all of it is told, at every range and elevation.
TEST(TotalEcho, IsTheBodysEcho) {
  double sum_db = 0.0;
  int n = 0;
  for (const double range_m : {90.0, 180.0, 300.0}) {
    for (const double elevation_deg : {-35.0, -22.0, -10.0}) {
      test::MeasuredPing ping;
      const test::Ellipsoid e = school(range_m, elevation_deg, 268.0);
      ping.add(e);
      fill_with_water(ping);
      const SchoolPingRow row = ping.measured(static_cast<std::uint64_t>(range_m - elevation_deg));
      const double off_db = db_from_linear(row.backscatter_total_m2 / body_m2(e));
      EXPECT_NEAR(off_db, 0.0, 0.35) << range_m << " " << elevation_deg;
      EXPECT_GT(row.backscatter_total_m2, row.backscatter_m2);
      sum_db += off_db;
      ++n;
    }
  }
  EXPECT_NEAR(sum_db / n, 0.0, 0.12);
}

// Voxels of the test's water fade each by itself; those of beams that overlap do not, and the error is told for them: here,
// where each fan has its frequency, it is too large by the root of what neighbouring beams share.
TEST(TotalEcho, ItsErrorIsTheScatterOfFading) {
  test::MeasuredPing ping;
  for (std::size_t fan = 0; fan < 20; ++fan) ping.grid.frequency_hz[fan] += 2000.0 * static_cast<double>(fan);
  const test::Ellipsoid e = school(200.0, -18.0, 266.0);
  ping.add(e);
  fill_with_water(ping);
  double sum = 0.0;
  double squares = 0.0;
  double told = 0.0;
  constexpr int kSeeds = 24;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SchoolPingRow row = ping.measured(seed);
    sum += row.backscatter_total_m2;
    squares += row.backscatter_total_m2 * row.backscatter_total_m2;
    told += row.backscatter_total_se_m2 / kSeeds;
  }
  const double scatter = std::sqrt((squares - sum * sum / kSeeds) / (kSeeds - 1));
  // By hand: beams 2.5 degrees x cos 18 apart share exp(-1/2 (2.355 x 2.378 / 3.4)^2) = 0.258, those beyond 0.004.
  const double alike = std::sqrt(1.0 + 2.0 * (0.258 + 0.004));
  // a standard deviation of 24 is known to 15 %
  EXPECT_NEAR(told / scatter / alike, 1.0, 0.35);
}

// Two schools a beam apart: together they have the echo of both bodies, and no voxel is counted twice.
TEST(TotalEcho, NeighboursShareWhatLiesBetweenThem) {
  const std::array<test::Ellipsoid, 2> bodies{school(200.0, -18.0, 261.0), school(200.0, -18.0, 274.0)};
  test::MeasuredPing ping;
  std::array<PingMask, 2> masks;
  for (std::size_t i = 0; i < 2; ++i) {
    Array3<double> alone(ping.expected.shape());
    test::add_ellipsoid(alone, ping.sector, bodies[i]);
    masks[i] = test::truth_of(alone);
    test::add_ellipsoid(ping.expected, ping.sector, bodies[i]);
  }
  ASSERT_EQ(overlap(masks[0], masks[1]), 0U);
  fill_with_water(ping);
  const Array3<std::int16_t> counts = test::counts_of(ping.expected, 5, false);
  MeasureInput in;
  in.sv = counts.view();
  in.flags = ping.flags.view();
  in.sector = &ping.sector;
  in.grid = &ping.grid;
  const std::array<const PingMask*, 2> both{masks.data(), masks.data() + 1};
  const EchoClaims claims = echo_claims(in, both);
  double shared = 0.0;
  for (const PingMask& mask : masks) {
    shared += total_echo(in, mask, &claims).backscatter_m2;
  }
  const double truth = body_m2(bodies[0]) + body_m2(bodies[1]);
  EXPECT_NEAR(db_from_linear(shared / truth), 0.0, 0.1);
  const std::array<const PingMask*, 2> turned{both[1], both[0]};
  EXPECT_TRUE(std::ranges::equal(claims.count.all(), echo_claims(in, turned).count.all())) << "in whatever order";
}

// The seabed's echo beside a school is none of it.
TEST(TotalEcho, StopsAtBoundaries) {
  test::MeasuredPing ping;
  const test::Ellipsoid e = school(150.0, -20.0, 268.0);
  ping.add(e);
  fill_with_water(ping);
  int last = 0;
  for (const sonar::Run& run : ping.mask.runs) last = std::max(last, static_cast<int>(run.end()));
  for (int row = 0; row < 500; ++row) {
    for (int s = last + 2; s < 900; ++s) {
      ping.expected.view().row(row)[static_cast<std::size_t>(s)] = 0.1;
      ping.flags.view().row(row)[static_cast<std::size_t>(s)] |= SampleFlags::seabed;
    }
  }
  EXPECT_NEAR(db_from_linear(ping.measured(1, false).backscatter_total_m2 / body_m2(e)), 0.0, 0.25);
}

// Nor is what beams hear of it by their edges, before the seabed itself; members there are the school's all the same.
TEST(TotalEcho, StopsWhereBeamsHearTheSeabed) {
  test::MeasuredPing ping;
  const test::Ellipsoid e = school(150.0, -20.0, 268.0);
  ping.add(e);
  fill_with_water(ping);
  Seabed seabed;
  seabed.found = true;
  seabed.offset_m = 400.0;
  seabed.first_sample.assign(500, 900);
  seabed.heard_sample.assign(500, 900);
  int last = 0;
  for (const sonar::Run& run : ping.mask.runs) last = std::max(last, static_cast<int>(run.end()));
  for (int row = 0; row < 500; ++row) {
    // in every other fan it is heard from the school's middle on
    seabed.heard_sample[static_cast<std::size_t>(row)] = row / 25 % 2 == 0 ? last : last - 20;
    for (int s = last; s < 900; ++s) ping.expected.view().row(row)[static_cast<std::size_t>(s)] = 0.1;
  }
  ping.seabed = &seabed;
  const SchoolPingRow row = ping.measured(1, false);
  EXPECT_NEAR(db_from_linear(row.backscatter_total_m2 / body_m2(e)), 0.0, 0.3);
  EXPECT_NEAR(row.height_corrected_m / (2.0 * e.half_z), 1.0, 0.15);
}

}  // namespace
}  // namespace sonar
