// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/avoidance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sonar {
namespace {

ObservationProduct product_of(const std::vector<std::int64_t>& schools) {
  ObservationProduct product;
  product.observation = "obs-0001";
  for (const std::int64_t id : schools) {
    SchoolRow row;
    row.observation = product.observation;
    row.school_id = id;
    product.schools.push_back(row);
  }
  return product;
}

SchoolPingRow& add(ObservationProduct& product, std::int64_t school, double range_m, double away_mps) {
  SchoolPingRow row;
  row.observation = product.observation;
  row.school_id = school;
  row.ping_index = std::ssize(product.school_pings);
  row.range_m = range_m;
  row.speed_away_mps = away_mps;
  row.sv_mean_db = -40.0;
  row.depth_min_m = 60.0;
  product.school_pings.push_back(row);
  return product.school_pings.back();
}

const AvoidanceRow* bin(const std::vector<AvoidanceRow>& rows, const std::string& against, double from) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const AvoidanceRow& r) { return r.against == against && r.from == from; });
  return found == rows.end() ? nullptr : &*found;
}

// By hand: schools of means 1.0 (of 0.9 and 1.1), 2.0 and 4.5; their mean 2.5, variance (2.25 + 0.25 + 4) / 2 = 3.25,
// error sqrt(3.25 / 3). A hundred pings more of the first change nothing.
TEST(Avoidance, SchoolsCountOnceAndErrorsAreThoseBetweenThem) {
  ObservationProduct product = product_of({1, 2, 3});
  for (int i = 0; i < 100; ++i) {
    add(product, 1, 110, 0.9);
    add(product, 1, 140, 1.1);
  }
  add(product, 2, 120, 2.0);
  add(product, 3, 149, 4.5);
  add(product, 3, 151, 9.0);  // the next bin
  const auto rows = avoidance_table(std::vector{product});
  const AvoidanceRow* found = bin(rows, "range_m", 100);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->to, 150.0);
  EXPECT_EQ(found->n_schools, 3);
  EXPECT_EQ(found->n_pings, 202);
  EXPECT_NEAR(found->speed_away_mps, 2.5, 1e-12);
  EXPECT_NEAR(found->speed_away_se_mps, std::sqrt(3.25 / 3.0), 1e-12);
  EXPECT_NEAR(bin(rows, "range_m", 150)->speed_away_mps, 9.0, 1e-12);
  EXPECT_TRUE(std::isnan(bin(rows, "range_m", 150)->speed_away_se_mps)) << "one school";
  EXPECT_EQ(bin(rows, "time_to_cpa_s", 0), nullptr) << "no ping tells it";
}

// By hand: sv 1e-4 and 3e-4, mean 2e-4, error 1e-4, which is 4.343 / 2 dB.
TEST(Avoidance, DensitiesAreAveragedBeforeDecibels) {
  ObservationProduct product = product_of({1, 2});
  add(product, 1, 10, 0).sv_mean_db = -40.0;
  add(product, 2, 10, 0).sv_mean_db = 10.0 * std::log10(3e-4);
  const auto rows = avoidance_table(std::vector{product});
  EXPECT_NEAR(rows.front().sv_mean_db, 10.0 * std::log10(2e-4), 1e-9);
  EXPECT_NEAR(rows.front().sv_mean_se_db, 10.0 / std::log(10.0) / 2.0, 1e-9);
}

// By numpy: np.percentile([1, 2, 4, 8], [25, 50, 75]) is 1.75, 3, 5; of [-50, -40] it is -47.5, -45, -42.5. The three pings of
// the first school are one value, 1.
TEST(Avoidance, QuartilesAreOfSchoolsAsNumpyHasThem) {
  ObservationProduct product = product_of({1, 2, 3, 4});
  for (const double away : {0.5, 0.5, 2.0}) add(product, 1, 10, away);
  add(product, 2, 10, 8.0);
  add(product, 3, 10, 2.0);
  add(product, 4, 10, 4.0);
  for (SchoolPingRow& row : product.school_pings) row.sv_mean_db = kUnknown;
  product.school_pings[3].sv_mean_db = -40.0;
  product.school_pings[4].sv_mean_db = -50.0;
  const AvoidanceRow row = avoidance_table(std::vector{product}).front();
  EXPECT_NEAR(row.speed_away_p25_mps, 1.75, 1e-12);
  EXPECT_NEAR(row.speed_away_p50_mps, 3.0, 1e-12);
  EXPECT_NEAR(row.speed_away_p75_mps, 5.0, 1e-12);
  EXPECT_NEAR(row.sv_mean_p25_db, -47.5, 1e-9);
  EXPECT_NEAR(row.sv_mean_p50_db, -45.0, 1e-9);
  EXPECT_NEAR(row.sv_mean_p75_db, -42.5, 1e-9);
  EXPECT_TRUE(std::isnan(row.speed_smoothed_p50_mps)) << "no ping tells it";
}

TEST(Avoidance, BinsOfTimeAndBearingGoBelowZero) {
  ObservationProduct product = product_of({1});
  auto& row = add(product, 1, 10, 0.5);
  row.time_to_cpa_s = -1.0;
  row.relative_bearing_deg = -95.0;
  const auto rows = avoidance_table(std::vector{product});
  EXPECT_NE(bin(rows, "time_to_cpa_s", -30), nullptr);
  EXPECT_NE(bin(rows, "relative_bearing_deg", -120), nullptr);
}

TEST(Avoidance, NeitherRejectedSchoolsNorTheWakeNorOneOfTwoRowsTwice) {
  ObservationProduct product = product_of({1, 2, 3, 4});
  product.schools[1].status = "rejected";
  product.schools[3].continues = "obs-0001/1";
  add(product, 1, 10, 1.0);
  add(product, 2, 10, 50.0);
  auto& wake = add(product, 3, 10, 50.0);
  wake.wake_distance_m = 10.0;
  wake.depth_min_m = 5.0;
  auto& deep = add(product, 3, 10, 3.0);  // under the wake
  deep.wake_distance_m = 10.0;
  add(product, 4, 10, 1.0);
  const auto rows = avoidance_table(std::vector{product});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows.front().n_schools, 2);
  EXPECT_EQ(rows.front().n_pings, 3);
  EXPECT_NEAR(rows.front().speed_away_mps, 2.0, 1e-12);
}

}  // namespace
}  // namespace sonar
