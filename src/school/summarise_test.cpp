// SPDX-License-Identifier: Apache-2.0
#include "school/summarise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"

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
  EXPECT_NEAR(row.sv_mean_db, db_from_linear((1e-5 + 1e-4 + 1e-5) / 3.0), 1e-9);
  EXPECT_TRUE(std::isnan(row.speed_mps));  // three centres are left
  for (auto& r : rows) r.touches_edge = 1;
  EXPECT_EQ(summarise(rows, {}).n_pings_whole, 0);
  EXPECT_DOUBLE_EQ(summarise(rows, {}).volume_m3, 102.0);  // median of all
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
