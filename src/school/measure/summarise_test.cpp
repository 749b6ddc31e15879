// SPDX-License-Identifier: Apache-2.0
#include "school/measure/summarise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/test_water.h"

namespace sonar {
namespace {

/// A school that swims 0.6 m/s east and 0.8 m/s north, sinking 0.1 m/s; a ping every 5 s.
std::vector<SchoolPingRow> swimming(int pings, Geographic start, double scale = 1.0) {
  std::vector<SchoolPingRow> rows;
  for (int i = 0; i < pings; ++i) {
    SchoolPingRow row;
    row.ping_index = i;
    row.time_utc = 1'600'000'000 * kSecondNs + i * 5 * kSecondNs;
    const Geographic at = to_geographic(Point<Enu>{scale * 3.0 * i, scale * 4.0 * i, 0.0}, start);
    row.latitude = at.latitude_deg;
    row.longitude = at.longitude_deg;
    row.depth_m = 50.0 + scale * 0.5 * i;
    row.sv_mean_db = i % 2 == 0 ? -40.0 : -50.0;
    row.backscatter_m2 = 1.0 + i;
    row.volume_m3 = 100.0 + i;
    rows.push_back(row);
  }
  return rows;
}

TEST(Summarise, FindsSpeedAnywhere) {
  for (const Geographic start :
       {Geographic{60, 4}, Geographic{70, 20}, Geographic{-55, 179.9999}, Geographic{10, -179.9999}}) {
    const SchoolRow row = summarise(swimming(10, start), {});
    EXPECT_NEAR(row.speed_mps, 1.0, 1e-3);
    EXPECT_NEAR(row.course_deg, deg_from_rad(std::atan2(0.6, 0.8)), 0.1);
    EXPECT_NEAR(row.vertical_speed_mps, 0.1, 1e-9);  // down
    EXPECT_NEAR(row.speed_se_mps, 0.0, 1e-3);
    EXPECT_NEAR(std::abs(wrap_180(row.longitude - start.longitude_deg)), 0.0, 0.001);
  }
}

TEST(Summarise, EqualPingsStandStill) {
  const SchoolRow row = summarise(swimming(6, {60, 4}, 0.0), {});
  EXPECT_NEAR(row.speed_mps, 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(row.course_deg));
}

TEST(Summarise, ShortTracksHaveNoSpeed) {
  EXPECT_TRUE(std::isnan(summarise(swimming(3, {60, 4}), {}).speed_mps));
  auto quick = swimming(8, {60, 4});
  for (auto& row : quick) row.time_utc = 1'600'000'000 * kSecondNs + row.ping_index * kSecondNs;  // 7 s
  EXPECT_TRUE(std::isnan(summarise(quick, {}).speed_mps));
}

TEST(Summarise, TakesWholePingsWhereThereAreAny) {
  auto rows = swimming(5, {60, 4});
  for (std::size_t i : {std::size_t{0}, std::size_t{4}}) {
    rows[i].touches_edge = 1;
    rows[i].edge_flags = kEdgeFore;
  }
  const SchoolRow row = summarise(rows, {});
  EXPECT_EQ(row.n_pings, 5);
  EXPECT_EQ(row.n_pings_whole, 3);
  EXPECT_DOUBLE_EQ(row.touches_edge_fraction, 0.4);
  EXPECT_DOUBLE_EQ(row.volume_m3, 102.0);     // median of 101, 102, 103
  EXPECT_DOUBLE_EQ(row.backscatter_m2, 3.0);  // mean of 2, 3, 4
  EXPECT_TRUE(std::isnan(row.volume_corrected_m3)) << "no ping knows it";
  EXPECT_TRUE(std::isnan(row.sv_corrected_db));
  EXPECT_NEAR(row.sv_mean_db, db_from_linear((1e-5 + 1e-4 + 1e-5) / 3.0), 1e-9);
  EXPECT_TRUE(std::isnan(row.speed_mps));  // three centres are left
  for (auto& r : rows) r.touches_edge = 1;
  EXPECT_EQ(summarise(rows, {}).n_pings_whole, 0);
  EXPECT_DOUBLE_EQ(summarise(rows, {}).volume_m3, 102.0);  // median of all
}

// By hand: pings 1 and 3 know both; backscatter (2 + 4) / 2, volume (50 + 150) / 2, hence 10 log10(3 / 100).
TEST(Summarise, CorrectedVolumeSvAndBackscatterMultiply) {
  auto rows = swimming(5, {60, 4});
  rows[1].volume_corrected_m3 = 50.0;
  rows[3].volume_corrected_m3 = 150.0;
  rows[4].volume_corrected_m3 = 1e4;
  rows[4].backscatter_m2 = kUnknown;
  for (auto& row : rows) row.sv_corrected_db = -60.0;  // a ping's own ratio says nothing here
  const SchoolRow row = summarise(rows, {});
  EXPECT_DOUBLE_EQ(row.backscatter_m2, 3.0);
  EXPECT_DOUBLE_EQ(row.volume_corrected_m3, 100.0);
  EXPECT_DOUBLE_EQ(row.sv_corrected_db, 10.0 * std::log10(0.03));
  EXPECT_DOUBLE_EQ(row.volume_m3, 102.0) << "apparent sizes: the median of all";
}

// By hand: 1 + 2 over 1 x 10^0.3 + 2 x 10^0.6 for errors of -3 and -6 dB; standard errors 0.2 and 0.5, weighted 1 to 2.
TEST(Summarise, TheCalibrationsErrorsAreWeightedAsBackscatterIs) {
  auto rows = swimming(2, {60, 4});
  rows[0].backscatter_psi_error_db = -3.0;
  rows[1].backscatter_psi_error_db = -6.0;
  rows[0].backscatter_calibration_se_db = 0.2;
  rows[1].backscatter_calibration_se_db = 0.5;
  const SchoolRow row = summarise(rows, {});
  EXPECT_NEAR(row.backscatter_psi_error_db, db_from_linear(3.0 / (std::pow(10.0, 0.3) + 2.0 * std::pow(10.0, 0.6))),
              1e-12);
  EXPECT_NEAR(row.backscatter_calibration_se_db, 0.4, 1e-12);
  rows[1].backscatter_psi_error_db = kUnknown;
  EXPECT_TRUE(std::isnan(summarise(rows, {}).backscatter_psi_error_db));
}

// Form and place as medians, levels and NASC as linear means; what a ping does not know is left out.
TEST(Summarise, DescriptorsAreMediansAndLevelsLinearMeans) {
  auto rows = swimming(3, {60, 4});
  const double sizes[] = {10.0, 90.0, 20.0};
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].surface_m2 = sizes[i];
    rows[i].nasc_m2_nmi2 = sizes[i];
    rows[i].n_vacuoles = i == 1 ? kUnknown : sizes[i];
    rows[i].sv_robust_mean_db = i == 0 ? -40.0 : kUnknown;
  }
  rows[2].sv_robust_mean_db = -50.0;
  const SchoolRow row = summarise(rows, {});
  EXPECT_DOUBLE_EQ(row.surface_m2, 20.0);
  EXPECT_DOUBLE_EQ(row.nasc_m2_nmi2, 40.0);
  EXPECT_DOUBLE_EQ(row.n_vacuoles, 15.0);
  EXPECT_NEAR(row.sv_robust_mean_db, db_from_linear((1e-4 + 1e-5) / 2.0), 1e-9);
  EXPECT_TRUE(std::isnan(row.incidence_deg));
}

/// Centres of a school of known speed, seen with an error of 4 m each way whose correlation from ping to ping is given.
std::vector<SchoolPingRow> wandering(int pings, double speed_mps, double correlation, std::uint64_t track) {
  std::vector<SchoolPingRow> rows = swimming(pings, {60, 4}, 0.0);
  Point<Enu> off;
  for (int i = 0; i < pings; ++i) {
    const double before = i == 0 ? 0.0 : correlation;
    const std::uint64_t seed = (track * 1000 + static_cast<std::uint64_t>(i)) * 2;
    const double fresh_m = 4.0 * std::sqrt(1.0 - before * before);
    off = Point<Enu>{before * off.x + fresh_m * test::normal(seed), before * off.y + fresh_m * test::normal(seed + 1),
                     0.0};
    const double path_m = speed_mps * 5.0 * i;
    const Geographic at = to_geographic(Point<Enu>{0.6 * path_m + off.x, 0.8 * path_m + off.y, 0.0}, {60, 4});
    rows[static_cast<std::size_t>(i)].latitude = at.latitude_deg;
    rows[static_cast<std::size_t>(i)].longitude = at.longitude_deg;
  }
  return rows;
}

struct Judgement {
  double bias_mps = 0.0;
  double line_bias_mps = 0.0;  ///< of the line's own length
  double covered = 0.0;        ///< share within one standard error
};

Judgement judge(int pings, double speed_mps, double correlation) {
  constexpr int kTracks = 600;
  Judgement out;
  for (int track = 0; track < kTracks; ++track) {
    const SchoolRow row = summarise(wandering(pings, speed_mps, correlation, static_cast<std::uint64_t>(track)), {});
    const double off = row.speed_mps - speed_mps;
    out.bias_mps += off / kTracks;
    out.line_bias_mps += (std::hypot(row.speed_mps, row.speed_se_mps) - speed_mps) / kTracks;
    out.covered += std::abs(off) <= row.speed_se_mps ? 1.0 / kTracks : 0.0;
  }
  return out;
}

// 600 tracks tell a share to 0.02 and a bias to a twentieth of the standard error. A still school's speed is a length: it
// keeps 0.76 of the error that the length of the plain line has 1.25 of.
TEST(Summarise, SlowSchoolsAreNotToldTooFastAndTheErrorIsWhatItSays) {
  for (const int pings : {15, 40}) {
    for (const double correlation : {0.0, 0.5, 0.8}) {
      for (const double speed_mps : {0.0, 0.3, 1.0, 2.0}) {
        const Judgement found = judge(pings, speed_mps, correlation);
        EXPECT_NEAR(found.covered, 0.68, 0.12) << pings << " " << correlation << " " << speed_mps;
        EXPECT_LT(std::abs(found.bias_mps), speed_mps > 0.0 ? 0.02 : 0.08)
            << pings << " " << correlation << " " << speed_mps;
        if (speed_mps == 0.0) {
          EXPECT_LT(found.bias_mps, 0.75 * found.line_bias_mps) << pings << " " << correlation;
        }
      }
    }
  }
}

TEST(Summarise, CutAboveOrBelowStillTellsSpeed) {
  auto rows = swimming(6, {60, 4});
  for (auto& r : rows) {
    r.touches_edge = 1;
    r.edge_flags = kEdgeTopFan;
  }
  EXPECT_NEAR(summarise(rows, {}).speed_mps, 1.0, 1e-3);
}

}  // namespace
}  // namespace sonar
