// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/product_example.h"
#include "pipeline/score/score.h"

namespace sonar {
namespace {

using nlohmann::json;

/// 12 samples of `lower` beams of one fan and of `upper` beams of the next. The example's fans look to -25, -15 and -5
/// degrees.
PingMask two_fans(int fan, int lower, int upper, int first_sample) {
  return unite(example::block(fan, 0, lower, first_sample, 12), example::block(fan + 1, 0, upper, first_sample, 12));
}

/// A true school and what is found of it.
struct Case {
  double range_m;
  PingMask mask;
  double backscatter_factor;
  double length_factor;
};

struct Sides {
  ScoreSide found, truth;
};

/// Numbers 1, 2, ... in the order of the cases; four pings each, so that all count.
Sides sides_of(const std::vector<Case>& cases) {
  ObservationProduct truth = example::empty("obs-0001", 4);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    example::add_school(truth, static_cast<std::int64_t>(i) + 1, 0, 3, cases[i].mask);
  }
  for (SchoolPingRow& row : truth.school_pings) {
    row.range_m = cases[static_cast<std::size_t>(row.school_id) - 1].range_m;
    row.length_corrected_m = 20.0;
    row.width_corrected_m = 10.0;
    row.height_corrected_m = 5.0;
  }
  ObservationProduct found = truth;
  for (SchoolPingRow& row : found.school_pings) {
    const Case& c = cases[static_cast<std::size_t>(row.school_id) - 1];
    row.backscatter_m2 *= c.backscatter_factor;
    row.length_corrected_m *= c.length_factor;
    row.width_corrected_m *= 0.9;
    row.height_corrected_m *= 1.2;
  }
  Sides sides;
  sides.found.observations = {found};
  sides.truth.observations = {truth};
  return sides;
}

json summary_of(const Sides& sides) { return json::parse(score_json(score(sides.found, sides.truth)))["summary"]; }

TEST(ScorePlace, thirds_of_a_stretch) {
  EXPECT_EQ(third_of(0.0, 0.0, 90.0), 0);
  EXPECT_EQ(third_of(29.9, 0.0, 90.0), 0);
  EXPECT_EQ(third_of(30.0, 0.0, 90.0), 1);
  EXPECT_EQ(third_of(60.0, 0.0, 90.0), 2);
  EXPECT_EQ(third_of(-5.0, 0.0, 90.0), 0) << "what is beyond an end lies in the third there";
  EXPECT_EQ(third_of(95.0, 0.0, 90.0), 2);
  EXPECT_EQ(third_of(-40.0, -45.0, 0.0), 0) << "from the deepest on";
  EXPECT_EQ(third_of(-1.0, -45.0, 0.0), 2);
  EXPECT_EQ(third_of(kUnknown, 0.0, 90.0), -1);
  EXPECT_EQ(third_of(1.0, kUnknown, 90.0), -1);
  EXPECT_EQ(third_of(1.0, 1.0, 1.0), -1);
  EXPECT_TRUE(std::isnan(score(ScoreSide{}, ScoreSide{}).span.range_to_m));
}

/// The example's sector: 60 samples of 2 m from -1 m on end at 119 m; fans 10 degrees apart round -25, -15 and -5 reach
/// from -30 to 0. Thirds: 39.7 and 79.3 m; -20 and -10 degrees.
TEST(ScorePlace, signed_medians_of_thirds_by_hand) {
  const Sides sides = sides_of({
      {30.0, two_fans(0, 3, 1, 5), 2.0, 1.1},    // (3 * -25 - 15) / 4 = -22.5 degrees: the deepest third; +3.01 dB
      {60.0, two_fans(0, 1, 3, 20), 0.5, 0.9},   // -17.5: the middle one; -3.01 dB
      {35.0, two_fans(0, 1, 3, 35), 1.0, 1.3},   // -17.5
      {110.0, two_fans(1, 1, 3, 48), 4.0, 1.0},  // (-15 - 15) / 4 = -7.5: the highest; +6.02 dB
  });
  const Score result = score(sides.found, sides.truth);
  EXPECT_NEAR(result.span.range_to_m, 119.0, 1e-9);
  EXPECT_NEAR(result.span.elevation_from_deg, -30.0, 1e-9);
  EXPECT_NEAR(result.span.elevation_to_deg, 0.0, 1e-9);
  EXPECT_EQ(result.pings, 4);
  ASSERT_EQ(result.schools.size(), 4U);
  EXPECT_NEAR(result.schools[0].elevation_deg, -22.5, 1e-12);
  EXPECT_NEAR(result.schools[3].elevation_deg, -7.5, 1e-12);
  EXPECT_NEAR(result.schools[0].length_corrected_ratio, 1.1, 1e-12);
  EXPECT_NEAR(result.schools[0].width_corrected_ratio, 0.9, 1e-12);
  EXPECT_NEAR(result.schools[0].height_corrected_ratio, 1.2, 1e-12);

  const json summary = summary_of(sides);
  EXPECT_EQ(summary["pings"], 4);
  const json& range = summary["by_range_third"];
  ASSERT_EQ(range.size(), 3U);
  EXPECT_NEAR(range[1]["from_m"].get<double>(), 119.0 / 3, 1e-9);
  EXPECT_NEAR(range[1]["to_m"].get<double>(), 238.0 / 3, 1e-9);
  EXPECT_EQ(range[0]["counted"], 2);
  EXPECT_EQ(range[0]["n"]["backscatter_error_db"], 2);
  EXPECT_NEAR(range[0]["backscatter_error_db"].get<double>(), 3.0103 / 2, 1e-4) << "between 0 and +3.01 dB";
  EXPECT_NEAR(range[0]["length_corrected_ratio_error"].get<double>(), 0.2, 1e-12) << "between +0.1 and +0.3";
  EXPECT_NEAR(range[1]["backscatter_error_db"].get<double>(), -3.0103, 1e-4) << "with its sign";
  EXPECT_NEAR(range[1]["length_corrected_ratio_error"].get<double>(), -0.1, 1e-12);
  EXPECT_NEAR(range[2]["backscatter_error_db"].get<double>(), 6.0206, 1e-4);
  const json& elevation = summary["by_elevation_third"];
  ASSERT_EQ(elevation.size(), 3U);
  EXPECT_NEAR(elevation[0]["to_deg"].get<double>(), -20.0, 1e-9);
  EXPECT_EQ(elevation[1]["counted"], 2);
  EXPECT_NEAR(elevation[0]["backscatter_error_db"].get<double>(), 3.0103, 1e-4);
  EXPECT_NEAR(elevation[1]["backscatter_error_db"].get<double>(), -3.0103 / 2, 1e-4);
  EXPECT_NEAR(elevation[2]["backscatter_error_db"].get<double>(), 6.0206, 1e-4);
  EXPECT_NEAR(elevation[2]["height_corrected_ratio_error"].get<double>(), 0.2, 1e-12);
}

/// A law: with the sides exchanged every signed error in dB is its own opposite; in ratios 1 + e becomes 1 / (1 + e).
TEST(ScorePlace, exchanged_sides_turn_the_signs) {
  const Sides sides = sides_of({{20.0, two_fans(0, 3, 2, 5), 1.7, 1.1},
                                {50.0, two_fans(0, 2, 3, 20), 0.6, 0.8},
                                {115.0, two_fans(1, 3, 3, 40), 2.9, 1.4}});
  const json forth = summary_of(sides);
  const json back = summary_of({sides.truth, sides.found});
  for (const char* member : {"by_range_third", "by_elevation_third"}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const json& a = forth[member][i];
      const json& b = back[member][i];
      ASSERT_EQ(a["n"], b["n"]) << member;
      if (a["n"]["backscatter_error_db"] == 0) continue;
      EXPECT_NEAR(a["backscatter_error_db"].get<double>(), -b["backscatter_error_db"].get<double>(), 1e-9);
      if (a["n"]["backscatter_error_db"] != 1) continue;  // the law of ratios is one of single schools
      const double there = a["length_corrected_ratio_error"];
      EXPECT_NEAR((1.0 + there) * (1.0 + b["length_corrected_ratio_error"].get<double>()), 1.0, 1e-9);
    }
  }
  EXPECT_NEAR(forth["bias"]["backscatter_error_db"].get<double>(), -back["bias"]["backscatter_error_db"].get<double>(),
              1e-9);
}

/// Every school that counts is in one third of each kind, and what does not count or was not found is not told.
TEST(ScorePlace, thirds_share_out_what_counts) {
  Sides sides = sides_of({{20.0, two_fans(0, 3, 2, 5), 1.7, 1.0},
                          {50.0, example::block(0, 0, 2, 20, 9), 9.0, 1.0},  // too small to count
                          {50.0, two_fans(0, 3, 3, 30), 2.0, 1.0}});
  std::erase_if(sides.found.observations[0].masks, [](const SchoolMask& m) { return m.school_id == 3; });
  const json summary = summary_of(sides);
  for (const char* member : {"by_range_third", "by_elevation_third"}) {
    int counted = 0;
    int told = 0;
    for (const json& third : summary[member]) {
      counted += third["counted"].get<int>();
      told += third["n"]["backscatter_error_db"].get<int>();
    }
    EXPECT_EQ(counted, 2) << member;
    EXPECT_EQ(told, 1) << member;
  }
  EXPECT_TRUE(summary["by_range_third"][1]["backscatter_error_db"].is_null());
}

}  // namespace
}  // namespace sonar
