// SPDX-License-Identifier: Apache-2.0
#include "school/measure/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "geo/refraction.h"
#include "school/measure/correct_sizes.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

using Ping = test::MeasuredPing;

test::Ellipsoid ellipsoid(double range_m, double elevation_deg, double azimuth_deg) {
  test::Ellipsoid e;
  e.centre = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
  e.half_x = 20.0;
  e.half_y = 12.0;
  e.half_z = 6.0;
  e.sv = 1e-4;
  return e;
}

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

constexpr double kBody_m3 = 4.0 / 3.0 * std::numbers::pi * 20.0 * 12.0 * 6.0;

// Nobody tells which skirts a sonar's beams have: with what is assumed by default, both shapes come out.
TEST(Measure, CorrectedSizesAreTheBodysForEitherBeamShape) {
  for (const test::Beams beams : {test::Beams::gaussian, test::Beams::uniform_line}) {
    for (const double range_m : {100.0, 200.0, 300.0}) {
      for (const double elevation_deg : {-25.0, -12.0}) {
        Ping ping;
        test::Ellipsoid e = ellipsoid(range_m, elevation_deg, 268.0);
        e.beams = beams;
        // 12 m at 300 m are a third of the beam: what is left of them hangs on the shape
        if (range_m > 250.0) e.half_z = 10.0;
        const double body_m3 = kBody_m3 * e.half_z / 6.0;
        ping.add(e);
        const SchoolPingRow row = ping.measured(1, false);
        EXPECT_NEAR(row.length_corrected_m / 40.0, 1.0, 0.06) << range_m;
        EXPECT_NEAR(row.width_corrected_m / 24.0, 1.0, 0.08) << range_m;
        EXPECT_NEAR(row.volume_corrected_m3 / body_m3, 1.0, 0.25) << range_m << " " << elevation_deg;
        // backscatter within 1 dB of sv V of the body: the mask leaves out what is 10 dB down
        EXPECT_NEAR(db_from_linear(row.backscatter_m2 / (1e-4 * body_m3)), -0.4, 0.6) << range_m;
      }
    }
  }
}

// A sonar that sends wider than it receives has wider beams than their -3 dB widths say. Only the equivalent beam angle
// tells; how it is shared out between height and length the schools tell.
TEST(Measure, CorrectedSizesAreTheBodysWhereTheSonarSendsWide) {
  for (const test::Beams beams : {test::Beams::wide_transmit, test::Beams::wide_fan}) {
    for (const double elevation_deg : {-25.0, -12.0}) {
      for (const double range_m : {100.0, 200.0, 300.0}) {
        Ping ping;
        ping.beam_angle_db.assign(500, test::beam_angle_db(beams));
        test::Ellipsoid e = ellipsoid(range_m, elevation_deg, 268.0);
        e.beams = beams;
        if (range_m > 150.0) e.half_z = 10.0;
        ping.add(e);
        const SchoolPingRow row = ping.measured(1, false);
        EXPECT_NEAR(row.length_corrected_m / 40.0, 1.0, 0.06) << range_m;
        EXPECT_NEAR(row.width_corrected_m / 24.0, 1.0, 0.08) << range_m;
        EXPECT_NEAR(row.volume_corrected_m3 / (kBody_m3 * e.half_z / 6.0), 1.0, 0.25)
            << range_m << " " << elevation_deg;
        if (beams != test::Beams::wide_transmit) continue;
        ping.beam_angle_db.clear();  // nobody tells, and the body looks taller
        EXPECT_GT(ping.measured(1, false).height_corrected_m, 1.25 * 2.0 * e.half_z);
      }
    }
  }
}

// Balls of 30 m through beams that are sent for a whole fan at once, rippling by so much from crest to trough, as a real
// table's 0.5 to 2.4 dB; the law: a ball is as long at any range and under any beam.
TEST(Measure, BallsAreAsLongAsTheyAreWhereTheTransmitFanRipples) {
  for (const double ripple_db : {0.5, 1.5, 2.4}) {
    for (const double range_m : {100.0, 170.0, 240.0, 310.0}) {
      for (const double azimuth_deg : {262.0, 268.0, 275.5}) {
        Ping ping;
        test::Ellipsoid e = ellipsoid(range_m, -18.0, azimuth_deg);
        e.half_x = e.half_y = e.half_z = 15.0;
        e.beams = test::Beams::wide_fan;
        e.ripple_db = ripple_db;
        ping.add(e);
        ping.beam_angle_db = test::beam_angles_db(ping.sector, e.beams, ripple_db);
        const SchoolPingRow row = ping.measured(1, false);
        EXPECT_NEAR(row.length_corrected_m / 30.0, 1.0, 0.05)
            << ripple_db << " dB, " << range_m << " m, " << azimuth_deg;
      }
    }
  }
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

// Where the shape is known it can be told, and then nothing is left of the difference.
TEST(Measure, AKnownBeamShapeGivesTheHeight) {
  for (const double range_m : {100.0, 200.0, 300.0}) {
    Ping ping;
    test::Ellipsoid e = ellipsoid(range_m, -18.0, 268.0);
    ping.params.find_beam_shape = false;
    ping.params.beam_gaussian_share = 1.0;
    ping.add(e);
    EXPECT_NEAR(ping.measured(1, false).height_corrected_m / 12.0, 1.0, 0.10) << range_m;
    Ping line;
    e.beams = test::Beams::uniform_line;
    line.params.find_beam_shape = false;
    line.params.beam_gaussian_share = 0.0;
    line.add(e);
    EXPECT_NEAR(line.measured(1, false).height_corrected_m / 12.0, 1.0, 0.10) << range_m;
  }
}

constexpr double kLow_m = 14.0;

/// One school of this height at 230 .. 250 m, where the beam is 27 m, through speckled pings.
std::vector<MeasuredSchool> low_school(test::Beams beams, const MeasureParams& params, int pings) {
  std::vector<MeasuredSchool> seen;
  for (int i = 0; i < pings; ++i) {
    Ping ping;
    ping.params = params;
    test::Ellipsoid e = ellipsoid(230.0 + i, -15.0, 268.0);
    e.half_z = kLow_m / 2.0;
    e.beams = beams;
    ping.add(e);
    seen.push_back(ping.seen(static_cast<std::uint64_t>(i) + 1001));
    seen.back().row.ping_index = i;
  }
  return seen;
}

std::vector<SchoolPingRow> corrected(const std::vector<MeasuredSchool>& seen, const MeasureParams& params) {
  SchoolThroughPings school;
  for (const MeasuredSchool& one : seen) school.push_back(&one);
  return correct_sizes({school}, params);
}

double worst_height_error(const std::vector<SchoolPingRow>& rows) {
  double worst = 0.0;
  for (const SchoolPingRow& row : rows) {
    const double height = std::isnan(row.height_corrected_m) ? 0.0 : row.height_corrected_m;
    worst = std::max(worst, std::abs(height / kLow_m - 1.0));
  }
  return worst;
}

// One ping of speckle cannot tell a low body's height, nor the shape of the beam's skirts; twenty can, for either shape.
TEST(Measure, PingsTogetherTellALowBodysHeight) {
  for (const test::Beams beams : {test::Beams::gaussian, test::Beams::uniform_line}) {
    MeasureParams params;
    const std::vector<MeasuredSchool> seen = low_school(beams, params, 20);
    const double together = worst_height_error(corrected(seen, params));
    EXPECT_LT(together, 0.3);
    params.height_pool_pings = 0;
    EXPECT_GT(worst_height_error(corrected(seen, params)), together);
  }
}

// A ring has more spread than an ellipsoid of its extents, and a fourth moment that tells so.
TEST(Measure, ARingIsAsLongAndAsWideAsItIs) {
  constexpr double kAcross_m = 2.0 * (35.0 + 6.0);
  for (const double range_m : {150.0, 250.0}) {
    Ping ping;
    ping.params.density_looks = 0.0;  // as through many pings
    for (int k = 0; k < 12; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 12.0;
      test::Ellipsoid e = ellipsoid(range_m, -18.0, 268.0);
      e.centre = e.centre + Point<Sonar>{35.0 * std::cos(angle), 35.0 * std::sin(angle), 0.0};
      e.half_x = e.half_y = 6.0;
      test::add_ellipsoid(ping.expected, ping.sector, e);
    }
    ping.mask = test::truth_of(ping.expected);
    const SchoolPingRow row = ping.measured(1, false);
    EXPECT_NEAR(row.length_corrected_m / kAcross_m, 1.0, 0.06) << range_m;
    EXPECT_NEAR(row.width_corrected_m / kAcross_m, 1.0, 0.06) << range_m;
  }
}

TEST(Measure, PingsOutOfReachHaveNoSayInTheHeight) {
  MeasureParams params;
  params.find_beam_shape = false;  // that is the sonar's, and all pings have a say in it
  params.height_pool_pings = 2;
  std::vector<MeasuredSchool> seen = low_school(test::Beams::gaussian, params, 6);
  const double before = corrected(seen, params)[0].height_corrected_m;
  for (double& likelihood : seen[3].body.heights[0].at) likelihood = 0.0;
  EXPECT_EQ(corrected(seen, params)[0].height_corrected_m, before);
  EXPECT_NE(corrected(seen, params)[1].height_corrected_m, before);
}

// A ping whose fans make no sense together, as beside corrupted packets, must not decide for all others.
TEST(Measure, OnePingThatFitsNoBodyDoesNotDecide) {
  MeasureParams params;
  std::vector<MeasuredSchool> seen = low_school(test::Beams::gaussian, params, 20);
  for (HeightLikelihood& heights : seen[4].body.heights) {
    // far below what fits, and best for a body of more than 100 m
    for (std::size_t k = 0; k < heights.at.size(); ++k) {
      heights.at[k] = -10000.0 - 100.0 * static_cast<double>(heights.at.size() - k);
    }
  }
  EXPECT_LT(worst_height_error(corrected(seen, params)), 0.25);
}

TEST(Measure, CutByTheSurfaceTheHeightIsNotTold) {
  Ping ping;
  ping.add(ellipsoid(250.0, -6.0, 268.0));
  for (int row = 19 * 25; row < 20 * 25; ++row) {
    for (SampleFlags& flag : ping.flags.view().row(row)) flag |= SampleFlags::surface;
  }
  PingMask top;
  for (int row = 19 * 25; row < 20 * 25; ++row) top.runs.push_back({row, 0, 900});
  top.confidence.assign(25 * 900, 1);
  ping.mask = subtract(ping.mask, top);
  const SchoolPingRow row = ping.measured(1, false);
  ASSERT_NE(row.edge_flags & kEdgeSurface, 0);
  EXPECT_TRUE(std::isnan(row.height_corrected_m));
  EXPECT_TRUE(std::isnan(row.volume_corrected_m3));
  EXPECT_TRUE(std::isnan(row.sv_corrected_db));
  EXPECT_NEAR(row.length_corrected_m / 40.0, 1.0, 0.06);
  EXPECT_NEAR(row.width_corrected_m / 24.0, 1.0, 0.08);
}

TEST(Measure, CutByTheForeEdgeLengthAndWidthAreNotTold) {
  Ping ping;
  ping.add(ellipsoid(150.0, -18.0, 299.0));  // the last beam looks to 300 degrees
  const SchoolPingRow row = ping.measured(1, false);
  ASSERT_NE(row.edge_flags & kEdgeFore, 0);
  EXPECT_TRUE(std::isnan(row.length_corrected_m));
  EXPECT_TRUE(std::isnan(row.width_corrected_m));
  EXPECT_TRUE(std::isnan(row.volume_corrected_m3));
  EXPECT_TRUE(std::isnan(row.sv_corrected_db));
  EXPECT_NEAR(row.height_corrected_m / 12.0, 1.0, 0.15);
  EXPECT_GT(row.backscatter_m2, 0.0);
}

// A layer of 1 m at 350 m is a fortieth of the beam there: no height may be made up, nor what follows from it.
TEST(Measure, ALayerFarThinnerThanTheBeamHasNoHeight) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Ping ping;
    test::Ellipsoid e = ellipsoid(300.0, -15.0, 268.0);
    e.half_z = 0.5;
    e.sv = 1e-3;
    ping.add(e);
    const SchoolPingRow row = ping.measured(seed);
    EXPECT_EQ(std::isnan(row.height_corrected_m), std::isnan(row.volume_corrected_m3));
    EXPECT_EQ(std::isnan(row.height_corrected_m), std::isnan(row.sv_corrected_db));
    if (!std::isnan(row.height_corrected_m)) ++told;
  }
  EXPECT_LE(told, 2);
}

TEST(Measure, SpeckledSizesAreRight) {
  std::vector<double> volumes;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    Ping ping;
    ping.add(ellipsoid(200.0, -15.0, 268.0));
    volumes.push_back(ping.measured(seed).volume_corrected_m3);
  }
  std::nth_element(volumes.begin(), volumes.begin() + 4, volumes.end());
  EXPECT_NEAR(volumes[4] / kBody_m3, 1.0, 0.25);
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
