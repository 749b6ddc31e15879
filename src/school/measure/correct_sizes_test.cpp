// SPDX-License-Identifier: Apache-2.0
#include "school/measure/correct_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

using Ping = test::MeasuredPing;
using test::ellipsoid;

constexpr double kBody_m3 = 4.0 / 3.0 * std::numbers::pi * 20.0 * 12.0 * 6.0;

// Nobody tells which skirts a sonar's beams have: with what is assumed by default, both shapes come out.
TEST(CorrectSizes, CorrectedSizesAreTheBodysForEitherBeamShape) {
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
TEST(CorrectSizes, CorrectedSizesAreTheBodysWhereTheSonarSendsWide) {
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
TEST(CorrectSizes, BallsAreAsLongAsTheyAreWhereTheTransmitFanRipples) {
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

// Where the shape is known it can be told, and then nothing is left of the difference.
TEST(CorrectSizes, AKnownBeamShapeGivesTheHeight) {
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
TEST(CorrectSizes, PingsTogetherTellALowBodysHeight) {
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
TEST(CorrectSizes, ARingIsAsLongAndAsWideAsItIs) {
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

TEST(CorrectSizes, PingsOutOfReachHaveNoSayInTheHeight) {
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
TEST(CorrectSizes, OnePingThatFitsNoBodyDoesNotDecide) {
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

TEST(CorrectSizes, CutByTheSurfaceTheHeightIsNotTold) {
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

TEST(CorrectSizes, CutByTheForeEdgeLengthAndWidthAreNotTold) {
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
TEST(CorrectSizes, ALayerFarThinnerThanTheBeamHasNoHeight) {
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

TEST(CorrectSizes, SpeckledSizesAreRight) {
  std::vector<double> volumes;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    Ping ping;
    ping.add(ellipsoid(200.0, -15.0, 268.0));
    volumes.push_back(ping.measured(seed).volume_corrected_m3);
  }
  std::nth_element(volumes.begin(), volumes.begin() + 4, volumes.end());
  EXPECT_NEAR(volumes[4] / kBody_m3, 1.0, 0.25);
}

}  // namespace
}  // namespace sonar
