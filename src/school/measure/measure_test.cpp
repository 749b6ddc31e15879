// SPDX-License-Identifier: Apache-2.0
#include "school/measure/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/units.h"
#include "geo/geodesic.h"
#include "geo/refraction.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

using Ping = test::MeasuredPing;
using test::ellipsoid;

TEST(Measure, OneVoxelByHand) {
  Ping ping;
  // fan 0 at -45 degrees, beam 12 straight to port, sample 300: r = -0.75 + 300 x 0.3776 = 112.53 m
  ping.mask.runs = {{12, 300, 1}};
  ping.mask.confidence = {255};
  for (double& sv : ping.expected.all()) sv = 1e-5;
  const SchoolPingRow row = ping.measured(1, false);
  const double r = 112.53;
  EXPECT_NEAR(row.range_m, r, 1e-9);
  EXPECT_NEAR(row.bearing_deg, 270.0, 1e-9);
  EXPECT_NEAR(row.depth_m, 7.0 + r * std::sqrt(0.5), 1e-9);
  // cell: 2.5 degrees by sin(-43.8158) - sin(-46.1842) times r^2 dr (+ dr^3/12)
  const double sr =
      rad_from_deg(2.5) * (std::sin(rad_from_deg(-43.815789473684211)) - std::sin(rad_from_deg(-46.184210526315789)));
  EXPECT_NEAR(row.volume_m3, sr * (r * r * 0.3776 + 0.3776 * 0.3776 * 0.3776 / 12.0), 1e-6);
  // 1e-5 + 1e-9 less 1e-9, to the step of a count
  EXPECT_NEAR(row.sv_mean_db, -50.0, kDbPerCount);
  EXPECT_NEAR(row.backscatter_m2 / row.volume_m3, 1e-5, 3e-8);
  EXPECT_NEAR(row.snr_db, 40.0, 0.02);
  EXPECT_DOUBLE_EQ(row.valid_fraction, 1.0);
  EXPECT_EQ(row.n_voxels, 1);
  EXPECT_EQ(row.n_beams, 1);
  EXPECT_EQ(row.n_fans, 1);
  EXPECT_EQ(row.edge_flags, kEdgeBottomFan);
  EXPECT_NEAR(row.edge_fraction, 1.0 / 6.0, 1e-12);
  // corners: elevations -46.184.. and -43.816.., r -+ dr/2
  EXPECT_NEAR(row.depth_max_m, 7.0 + (r + 0.1888) * std::sin(rad_from_deg(46.184210526315789)), 1e-9);
  EXPECT_NEAR(row.depth_min_m, 7.0 + (r - 0.1888) * std::sin(rad_from_deg(43.815789473684211)), 1e-9);
  EXPECT_NEAR(row.height_m, row.depth_max_m - row.depth_min_m, 1e-12);
}

// By hand, two beams that hear alike and are 3 and 6 dB off: the whole
// over what it would be, 2 / (10^0.3 + 10^0.6); the standard errors' mean.
TEST(Measure, TheCalibrationsErrorsAreWeightedAsTheEchoIs) {
  Ping ping;
  ping.mask.runs = {{262, 300, 1}, {263, 300, 1}};
  ping.mask.confidence = {255, 255};
  for (double& sv : ping.expected.all()) sv = 1e-4;
  ping.psi_error_db.assign(500, 0.0);
  ping.psi_error_db[262] = -3.0;
  ping.psi_error_db[263] = -6.0;
  ping.calibration_se_db.assign(500, 0.2);
  ping.calibration_se_db[263] = 0.4;
  const SchoolPingRow row = ping.measured(1, false);
  EXPECT_NEAR(row.backscatter_psi_error_db, db_from_linear(2.0 / (std::pow(10.0, 0.3) + std::pow(10.0, 0.6))), 1e-3);
  EXPECT_NEAR(row.backscatter_calibration_se_db, 0.3, 1e-3);
  ping.psi_error_db[262] = kUnknown;
  EXPECT_TRUE(std::isnan(ping.measured(1, false).backscatter_psi_error_db));
  ping.psi_error_db.clear();
  EXPECT_TRUE(std::isnan(ping.measured(1, false).backscatter_psi_error_db));
}

TEST(Measure, UnderCorruptedPacketsTheMeanStays) {
  Ping clean;
  clean.add(ellipsoid(150.0, -18.0, 265.0));
  const SchoolPingRow expected = clean.measured(2);
  Ping hot = clean;
  const int row = 11 * 25 + 10;
  for (int s = 300; s < 600; ++s) hot.flags.view().row(row)[static_cast<std::size_t>(s)] |= SampleFlags::corrupted;
  hot.counts = test::counts_of(hot.expected, 2);
  const SchoolPingRow got = hot.measured(2);
  EXPECT_NEAR(got.sv_mean_db, expected.sv_mean_db, 1.0);
  EXPECT_NEAR(db_from_linear(got.backscatter_m2 / expected.backscatter_m2), 0.0, 1.0);
  EXPECT_LT(got.valid_fraction, 1.0);
  EXPECT_GT(got.valid_fraction, 0.7);
  EXPECT_NEAR(got.volume_corrected_m3 / expected.volume_corrected_m3, 1.0, 0.15);
}

/// Everything that must not change when the ship turns or sails elsewhere.
void expect_same_body(const SchoolPingRow& a, const SchoolPingRow& b) {
  EXPECT_NEAR(a.range_m, b.range_m, 1e-9);
  EXPECT_NEAR(a.depth_m, b.depth_m, 1e-9);
  EXPECT_NEAR(a.length_m, b.length_m, 1e-6);
  EXPECT_NEAR(a.width_m, b.width_m, 1e-6);
  EXPECT_NEAR(a.height_m, b.height_m, 1e-9);
  EXPECT_NEAR(a.volume_corrected_m3, b.volume_corrected_m3, 1e-6 * a.volume_corrected_m3);
  EXPECT_DOUBLE_EQ(a.sv_mean_db, b.sv_mean_db);
}

TEST(Measure, TurnsWithTheShip) {
  Ping ping;
  ping.add(ellipsoid(200.0, -15.0, 262.0));
  const SchoolPingRow north = ping.measured(1);
  for (const Geographic place :
       {Geographic{60, 4}, Geographic{70, 20}, Geographic{-30, 179.9995}, Geographic{5, -180}}) {
    for (const double heading_deg : {0.0, 90.0, 213.0}) {
      ping.placement.transducer = place;
      ping.placement.heading_rad = rad_from_deg(heading_deg);
      const SchoolPingRow turned = ping.measured(1);
      expect_same_body(north, turned);
      EXPECT_NEAR(wrap_180(turned.bearing_deg - north.bearing_deg - heading_deg), 0.0, 1e-6);
      EXPECT_NEAR(std::abs(std::remainder(turned.axis_deg - north.axis_deg - heading_deg, 180.0)), 0.0, 1e-6);
      const GeodesicStep step = geodesic(place, {turned.latitude, turned.longitude});
      EXPECT_NEAR(wrap_180(step.bearing_deg - turned.bearing_deg), 0.0, 1e-6);
      EXPECT_NEAR(step.distance_m, std::sqrt(north.range_m * north.range_m - std::pow(north.depth_m - 7.0, 2)), 1e-4);
    }
  }
}

TEST(Measure, MirroredMountingMirrorsTheSchool) {
  Ping port;
  port.add(ellipsoid(200.0, -15.0, 260.0));
  Ping starboard(90.0);
  starboard.mask = port.mask;
  for (sonar::Run& run : starboard.mask.runs) run.row = run.row / 25 * 25 + (24 - run.row % 25);
  std::sort(starboard.mask.runs.begin(), starboard.mask.runs.end());
  for (int f = 0; f < 20; ++f) {
    for (int b = 0; b < 25; ++b) {
      for (int s = 0; s < 900; ++s) starboard.expected(f, 24 - b, s) = port.expected(f, b, s);
    }
  }
  const SchoolPingRow a = port.measured(1, false);
  const SchoolPingRow b = starboard.measured(1, false);
  EXPECT_NEAR(a.range_m, b.range_m, 1e-6);
  EXPECT_NEAR(a.bearing_deg, 360.0 - b.bearing_deg, 1e-6);
  EXPECT_NEAR(a.depth_m, b.depth_m, 1e-9);
  EXPECT_NEAR(a.length_m, b.length_m, 1e-6);
  EXPECT_NEAR(std::remainder(a.axis_deg + b.axis_deg, 180.0), 0.0, 1e-6);
  EXPECT_NEAR(a.volume_corrected_m3 / b.volume_corrected_m3, 1.0, 1e-6);
}

// By hand: level to 100 m, sound in c = 1500 - 0.1 z comes from (100 m)^2 g / 2c = 0.33 m deeper. Straight paths only tell it;
// where they are bent, the depth follows and the error stays what it is. Without a profile it is unknown.
TEST(Measure, ToldAndBentRaysGiveOneDepth) {
  Ping ping;
  ping.add(ellipsoid(100.0, -1.0, 260.0));
  EXPECT_TRUE(std::isnan(ping.measured(1, false).depth_error_m));
  ping.rays = std::make_shared<const Refraction>(SoundProfile{{0, 1500}, {200, 1480}}, 7.0, 1499.3, 400.0);
  const SchoolPingRow straight = ping.measured(1, false);
  EXPECT_NEAR(straight.depth_error_m, straight.range_m * straight.range_m * 0.1 / (2 * 1499.3), 0.01);
  EXPECT_GT(straight.depth_error_m, 0.3);
  ping.placement.rays = ping.rays;
  const SchoolPingRow bent = ping.measured(1, false);
  EXPECT_NEAR(bent.depth_m, straight.depth_m + straight.depth_error_m, 1e-9);
  EXPECT_EQ(bent.depth_error_m, straight.depth_error_m);
  EXPECT_GT(bent.depth_max_m, straight.depth_max_m + 0.2);
  EXPECT_EQ(bent.range_m, straight.range_m);
  EXPECT_EQ(bent.backscatter_m2, straight.backscatter_m2);
  EXPECT_EQ(bent.volume_m3, straight.volume_m3);
}

}  // namespace
}  // namespace sonar
