// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/product_example.h"

namespace sonar {
namespace {

using nlohmann::json;

/// A school of 3 beams x 2 fans x 12 samples: enough to count.
PingMask large(int first_sample) {
  PingMask mask = example::block(0, 0, 3, first_sample, 12);
  const PingMask upper = example::block(1, 0, 3, first_sample, 12);
  mask.runs.insert(mask.runs.end(), upper.runs.begin(), upper.runs.end());
  mask.confidence.insert(mask.confidence.end(), upper.confidence.begin(), upper.confidence.end());
  return mask;
}

/// Two schools that count in ten pings.
ScoreSide truth() {
  ObservationProduct p = example::empty("obs-0001", 10);
  example::add_school(p, 1, 0, 9, large(10));
  example::add_school(p, 2, 0, 9, large(40));
  for (SchoolRow& school : p.schools) school.speed_mps = 0.5;
  ScoreSide side;
  side.observations = {p};
  return side;
}

json summary_of(const ScoreSide& found, const ScoreSide& with) {
  return json::parse(score_json(score(found, with)))["summary"];
}

TEST(Score, truth_scores_itself_one) {
  const Score result = score(truth(), truth());
  ASSERT_EQ(result.schools.size(), 2U);
  for (const SchoolScore& s : result.schools) {
    EXPECT_TRUE(s.counted);
    EXPECT_EQ(s.dice, 1.0);
    EXPECT_EQ(s.truth_id, s.found_id);
    EXPECT_EQ(s.volume_ratio, 1.0);
    EXPECT_EQ(s.volume_corrected_ratio, 1.0);
    EXPECT_EQ(s.cog_error_m, 0.0);
    EXPECT_EQ(s.sv_error_db, 0.0);
    EXPECT_EQ(s.backscatter_error_db, 0.0);
    EXPECT_EQ(s.speed_error_mps, 0.0);
    EXPECT_EQ(s.purity, 1.0);
    EXPECT_EQ(s.range_m, 60.0);
  }
  EXPECT_TRUE(result.false_schools.empty());
  const json summary = summary_of(truth(), truth());
  EXPECT_EQ(summary["found_fraction"], 1.0);
  EXPECT_EQ(summary["mean_dice"], 1.0);
}

TEST(Score, sides_without_a_common_ping_are_told) {
  EXPECT_TRUE(share_pings(truth(), truth()));
  ScoreSide other = truth();
  for (PingNavigation& ping : other.observations[0].pings) ping.time += 500'000'000;
  EXPECT_FALSE(share_pings(other, truth()));
  other.observations[0].pings[7].time = truth().observations[0].pings[7].time;
  EXPECT_TRUE(share_pings(other, truth()));
}

TEST(Score, empty_and_all_sea_score_zero) {
  ScoreSide none;
  none.observations = {example::empty("obs-0001", 10)};
  json summary = summary_of(none, truth());
  EXPECT_EQ(summary["found_fraction"], 0.0);
  EXPECT_EQ(summary["mean_dice"], 0.0);
  EXPECT_TRUE(summary["median"]["cog_error_m"].is_null());
  EXPECT_EQ(summary_of(ScoreSide{}, truth())["found_fraction"], 0.0);

  // The sea of a sector of 3 x 4 x 60 against schools that fill a tenth of it gives a Dice of 0.18; smaller schools
  // in a larger sea are the rule, so the sea here is one of 3 x 4 x 600.
  ScoreSide sea_truth = truth();
  sea_truth.observations[0].grid->range.count = 600;
  ObservationProduct sea = example::empty("obs-0001", 10);
  sea.grid->range.count = 600;
  PingMask all;
  for (int row = 0; row < 12; ++row) all.runs.push_back({row, 0, 600});
  all.confidence.assign(12 * 600, 255);
  example::add_school(sea, 1, 0, 9, all);
  ScoreSide flooded;
  flooded.observations = {sea};
  summary = summary_of(flooded, sea_truth);
  EXPECT_EQ(summary["found_fraction"], 0.0);
  EXPECT_EQ(summary["mean_dice"], 0.0);
}

TEST(Score, errors_worked_by_hand) {
  ScoreSide found = truth();
  ObservationProduct& p = found.observations[0];
  p.observation = "obs-0007";  // another name, the same time
  p.schools[0].speed_mps = 0.7;
  p.schools[0].sv_corrected_db = -43.0;
  for (SchoolPingRow& row : p.school_pings) {
    if (row.school_id != 1) continue;
    row.volume_m3 = 1100.0;
    row.volume_corrected_m3 = 400.0;
    row.backscatter_m2 *= 2.0;
    row.depth_m += 3.0;
    row.sv_mean_db = -44.0;
  }
  // Half of the voxels: Dice = 2 * 36 / (36 + 72).
  for (SchoolMask& m : p.masks) {
    if (m.school_id == 1) m.mask = example::block(0, 0, 3, 10, 12);
  }
  ScoreSide with_bodies = truth();
  for (std::int64_t ping = 0; ping < 10; ++ping) with_bodies.bodies[{"obs-0001", 1, ping}] = {800.0, 0.0316, 0.75};
  const Score result = score(found, with_bodies);
  const SchoolScore& s = result.schools[0];
  EXPECT_EQ(s.found_id, "obs-0007/1");
  EXPECT_NEAR(s.dice, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(s.volume_ratio, 1.1, 1e-12);
  EXPECT_NEAR(s.volume_corrected_ratio, 0.8, 1e-12);
  EXPECT_NEAR(s.backscatter_error_db, 3.0103, 1e-4);
  EXPECT_NEAR(s.sv_error_db, 1.0, 1e-9);
  EXPECT_NEAR(s.cog_error_m, 3.0, 1e-6);
  EXPECT_NEAR(s.speed_error_mps, 0.2, 1e-12);
  EXPECT_NEAR(s.body_volume_corrected_ratio, 0.5, 1e-12);
  EXPECT_NEAR(s.body_backscatter_error_db, 3.0103, 1e-4);
  // 0.0316 m2 in 800 m3 are -44.034 dB
  EXPECT_NEAR(s.body_sv_error_db, 1.034, 1e-3);
  EXPECT_EQ(s.inside, 0.75);
}

TEST(Score, only_unclipped_pings_are_judged) {
  ScoreSide with = truth();
  for (SchoolPingRow& row : with.observations[0].school_pings) row.touches_edge = row.ping_index < 8 ? 1 : 0;
  const Score result = score(truth(), with);
  EXPECT_EQ(result.schools[0].n_unclipped, 2);
  EXPECT_FALSE(result.schools[0].counted) << "two pings are too few";
  EXPECT_EQ(result.schools[0].dice, 1.0);
}

TEST(Score, purity_and_false_schools) {
  // One track holds school 1 in seven pings and school 2 in three; another one lies in empty water.
  ObservationProduct p = example::empty("obs-0001", 10);
  example::add_school(p, 1, 0, 6, large(10));
  for (int i = 7; i < 10; ++i) p.masks.push_back({1, i, large(40)});
  example::add_school(p, 2, 0, 4, example::block(2, 0, 4, 25, 10));
  ScoreSide found;
  found.observations = {p};
  const Score result = score(found, truth());
  EXPECT_EQ(result.schools[0].found_id, "obs-0001/1");
  EXPECT_NEAR(result.schools[0].purity, 0.7, 1e-12);
  EXPECT_NEAR(result.schools[0].dice, 0.7, 1e-12);
  ASSERT_EQ(result.false_schools.size(), 1U);
  EXPECT_EQ(result.false_schools[0].found_id, "obs-0001/2");
  EXPECT_EQ(result.false_schools[0].n_pings, 5);
  found.observations[0].schools.back().status = "rejected";
  EXPECT_TRUE(score(found, truth()).false_schools.empty());
}

/// A track of its own for a part of a school is a fragment; one that only grazes a school is false.
TEST(Score, fragments_lower_the_purity) {
  ObservationProduct p = example::empty("obs-0001", 10);
  example::add_school(p, 1, 0, 7, large(10));
  example::add_school(p, 2, 8, 9, large(10));
  example::add_school(p, 3, 0, 9, large(40));
  example::add_school(p, 4, 0, 4, example::block(2, 0, 4, 20, 10));
  p.masks.push_back({4, 5, example::block(1, 0, 1, 20, 10)});  // two voxels of ten in school 1
  ScoreSide found;
  found.observations = {p};
  const Score result = score(found, truth());
  EXPECT_EQ(result.schools[0].found_id, "obs-0001/1");
  EXPECT_EQ(result.schools[0].fragments, 1);
  EXPECT_NEAR(result.schools[0].purity, 0.8, 1e-12);
  EXPECT_EQ(result.schools[1].purity, 1.0);
  ASSERT_EQ(result.fragments.size(), 1U);
  EXPECT_EQ(result.fragments[0].found_id, "obs-0001/2");
  EXPECT_EQ(result.fragments[0].truth_id, "obs-0001/1");
  ASSERT_EQ(result.false_schools.size(), 1U);
  EXPECT_EQ(result.false_schools[0].found_id, "obs-0001/4");
  const json summary = summary_of(found, truth());
  EXPECT_EQ(summary["fragments"], 1);
  EXPECT_EQ(summary["merged"], 0);
  EXPECT_EQ(summary["found_fraction"], 1.0);
  EXPECT_NEAR(summary["min_purity"].get<double>(), 0.8, 1e-12);
}

/// Two schools in one track: found is the one that it is like in most pings.
TEST(Score, one_track_for_two_schools_has_found_one) {
  ObservationProduct p = example::empty("obs-0001", 10);
  PingMask both = large(10);
  const PingMask second = large(40);
  both = unite(both, second);
  PingMask mostly_second = unite(example::block(0, 0, 3, 10, 12), second);
  example::add_school(p, 1, 0, 2, both);
  for (int i = 3; i < 10; ++i) p.masks.push_back({1, i, mostly_second});
  ScoreSide found;
  found.observations = {p};
  const Score result = score(found, truth());
  EXPECT_EQ(result.schools[0].found_id, "obs-0001/1");
  EXPECT_EQ(result.schools[1].found_id, "obs-0001/1");
  EXPECT_TRUE(result.schools[0].merged);
  EXPECT_FALSE(result.schools[1].merged);
  ASSERT_EQ(result.merged.size(), 1U);
  EXPECT_EQ(result.merged[0].truth_ids, (std::vector<std::string>{"obs-0001/1", "obs-0001/2"}));
  EXPECT_TRUE(result.false_schools.empty());
  const json summary = summary_of(found, truth());
  EXPECT_EQ(summary["found"], 1);
  EXPECT_EQ(summary["merged"], 1);
  EXPECT_LT(summary["min_purity"].get<double>(), 0.5);
}

TEST(Score, grids_that_number_rows_differently_agree_by_channel) {
  ScoreSide found = truth();
  ObservationProduct& p = found.observations[0];
  // The same channels, fans counted from the other side.
  std::vector<int>& channel = p.grid->grid.channel;
  std::vector<int> turned;
  for (int fan = 2; fan >= 0; --fan) {
    for (int beam = 0; beam < 4; ++beam) turned.push_back(channel[static_cast<std::size_t>(fan * 4 + beam)]);
  }
  channel = turned;
  for (SchoolMask& m : p.masks) {
    PingMask mask = example::block(1, 0, 3, m.mask.runs[0].first_sample, 12);
    const PingMask upper = example::block(2, 0, 3, m.mask.runs[0].first_sample, 12);
    mask.runs.insert(mask.runs.end(), upper.runs.begin(), upper.runs.end());
    mask.confidence.insert(mask.confidence.end(), upper.confidence.begin(), upper.confidence.end());
    m.mask = mask;
  }
  EXPECT_EQ(score(found, truth()).schools[0].dice, 1.0);
}

TEST(Score, json_never_holds_nan) {
  ScoreSide with = truth();
  for (SchoolPingRow& row : with.observations[0].school_pings) row.volume_m3 = kUnknown;
  const std::string text = score_json(score(truth(), with));
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_TRUE(json::parse(text)["schools"][0]["volume_ratio"].is_null());
  EXPECT_FALSE(score_text(score(truth(), with)).empty());
  EXPECT_FALSE(score_text(score(ScoreSide{}, ScoreSide{})).empty());
}

}  // namespace
}  // namespace sonar
