// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/agree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/csv.h"
#include "io/product_example.h"

namespace sonar {
namespace {

using nlohmann::json;
using testing::HasSubstr;

ScoreSide side_of(ObservationProduct product) {
  ScoreSide side;
  side.observations = {std::move(product)};
  return side;
}

/// Three schools: one in ten pings, one in five that is rejected, one in four.
ObservationProduct anna() {
  ObservationProduct p = example::empty("obs-0001", 12);
  example::add_school(p, 1, 0, 9, example::block(0, 0, 3, 10, 12));
  example::add_school(p, 2, 2, 6, example::block(1, 0, 2, 30, 10));
  example::add_school(p, 3, 8, 11, example::block(2, 1, 3, 40, 8));
  p.schools[0].status = "accepted";
  p.schools[1].status = "rejected";
  return p;
}

/// School 1 of Anna half as large, three metres lower, twice as strong, in two pings fewer; her school 2 accepted; her
/// school 3 not there; one more of its own. Everything has other names.
ObservationProduct brit() {
  ObservationProduct p = example::empty("obs-0007", 12);
  example::add_school(p, 4, 2, 6, example::block(1, 0, 2, 30, 10));
  example::add_school(p, 5, 0, 7, example::block(0, 0, 3, 10, 6));
  example::add_school(p, 6, 0, 3, example::block(2, 0, 2, 5, 4));
  p.schools[0].status = "accepted";
  p.schools[1].status = "corrected";
  p.schools[1].operator_name = "Brit";
  for (SchoolPingRow& row : p.school_pings) {
    if (row.school_id != 5) continue;
    row.volume_m3 = 500.0;
    row.depth_m += 3.0;
    row.backscatter_m2 *= 2.0;
  }
  return p;
}

const AgreementRow& row_of(const Agreement& agreement, const std::string& a, const std::string& b) {
  const auto found = std::find_if(agreement.rows.begin(), agreement.rows.end(),
                                  [&](const AgreementRow& row) { return row.school_a == a && row.school_b == b; });
  EXPECT_NE(found, agreement.rows.end()) << a << " " << b;
  return *found;
}

// The example of Cohen's kappa that textbooks work: 20, 5, 10, 15. p_o = 35/50 = 0.7; A says yes in 25, B in 30 of 50:
// p_e = 0.5 * 0.6 + 0.5 * 0.4 = 0.5; kappa = 0.2 / 0.5 = 0.4. Standard error of Fleiss, Cohen & Everitt by hand:
//   diagonal   0.4 (1 - 1.1 * 0.6)^2 + 0.3 (1 - 0.9 * 0.6)^2 = 0.04624 + 0.06348
//   others     0.36 (0.1 * (0.6 + 0.5)^2 + 0.2 * (0.4 + 0.5)^2) = 0.10188
//   mean       (0.4 - 0.5 * 0.6)^2 = 0.01
//   variance   0.2016 / (50 * 0.25) = 0.016128
TEST(Kappa, worked_by_hand) {
  const Kappa kappa = cohen_kappa({{{20, 5}, {10, 15}}});
  EXPECT_EQ(kappa.units, 50);
  EXPECT_NEAR(kappa.agreed_fraction, 0.7, 1e-12);
  EXPECT_NEAR(kappa.agreed_yes_fraction, 40.0 / 55.0, 1e-12);
  EXPECT_NEAR(kappa.kappa, 0.4, 1e-12);
  EXPECT_NEAR(kappa.kappa_se, std::sqrt(0.016128), 1e-12);
  const Kappa swapped = cohen_kappa({{{20, 10}, {5, 15}}});
  EXPECT_NEAR(swapped.kappa, 0.4, 1e-12);
  EXPECT_NEAR(swapped.kappa_se, std::sqrt(0.016128), 1e-12);
}

/// Independent readers: their table is the product of its margins, and kappa 0, with the standard error of a quarter each.
TEST(Kappa, chance_perfection_and_what_cannot_be_told) {
  EXPECT_NEAR(cohen_kappa({{{12, 18}, {28, 42}}}).kappa, 0.0, 1e-12);
  EXPECT_NEAR(cohen_kappa({{{25, 25}, {25, 25}}}).kappa_se, 0.1, 1e-12);
  EXPECT_NEAR(cohen_kappa({{{0, 7}, {7, 0}}}).kappa, -1.0, 1e-12);
  const Kappa perfect = cohen_kappa({{{3, 0}, {0, 4}}});
  EXPECT_EQ(perfect.kappa, 1.0);
  EXPECT_NEAR(perfect.kappa_se, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(cohen_kappa({{{9, 0}, {0, 0}}}).kappa)) << "chance alone agrees as well";
  EXPECT_EQ(cohen_kappa({{{9, 0}, {0, 0}}}).agreed_fraction, 1.0);
  EXPECT_TRUE(std::isnan(cohen_kappa({{{1, 3}, {0, 0}}}).kappa)) << "whatever B says it would be 0";
  EXPECT_TRUE(std::isnan(cohen_kappa({}).agreed_fraction));
}

TEST(Agree, with_itself_is_perfect) {
  const Agreement same = agree(side_of(anna()), side_of(anna()));
  ASSERT_EQ(same.rows.size(), 3U);
  for (const AgreementRow& row : same.rows) {
    EXPECT_EQ(row.school_a, row.school_b);
    EXPECT_EQ(row.dice_low, 1.0);
    EXPECT_EQ(row.dice, 1.0);
    EXPECT_EQ(row.centre_distance_high_m, 0.0);
    EXPECT_EQ(row.volume_ratio, 1.0);
    EXPECT_EQ(row.backscatter_difference_db, 0.0);
    EXPECT_EQ(row.n_pings_a, row.n_pings_both);
    EXPECT_EQ(row.status_a, row.status_b);
  }
  EXPECT_EQ(same.schools.kappa, 1.0);
  EXPECT_EQ(same.voxel_dice, 1.0);
  EXPECT_EQ(same.pings, 12);
}

TEST(Agree, worked_by_hand) {
  const Agreement told = agree(side_of(anna()), side_of(brit()));
  ASSERT_EQ(told.rows.size(), 4U);
  const AgreementRow& both = row_of(told, "obs-0001/1", "obs-0007/5");
  EXPECT_EQ(both.n_pings_a, 10);
  EXPECT_EQ(both.n_pings_b, 8);
  EXPECT_EQ(both.n_pings_both, 8);
  // 2 * 18 / (36 + 18) in eight pings, nothing in two of Anna's.
  EXPECT_NEAR(both.dice, 8.0 / 10.0 * 2.0 / 3.0, 1e-12);
  EXPECT_EQ(both.dice_low, 0.0);
  EXPECT_NEAR(both.dice_high, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(both.centre_distance_m, 3.0, 1e-6);
  EXPECT_EQ(both.volume_a_m3, 1000.0);
  EXPECT_EQ(both.volume_b_m3, 500.0);
  EXPECT_NEAR(both.volume_ratio, 0.5, 1e-12);
  EXPECT_NEAR(both.backscatter_difference_db, 3.0103, 1e-4);
  EXPECT_NEAR(both.backscatter_difference_low_db, 3.0103, 1e-4);
  EXPECT_EQ(both.status_b, "corrected");
  EXPECT_EQ(both.operator_b, "Brit");
  EXPECT_EQ(row_of(told, "obs-0001/2", "obs-0007/4").dice, 1.0);
  const AgreementRow& alone = row_of(told, "obs-0001/3", "");
  EXPECT_TRUE(std::isnan(alone.dice));
  EXPECT_EQ(alone.status_a, "unreviewed");
  EXPECT_EQ(alone.lies_in, "");
  row_of(told, "", "obs-0007/6");
  // Both have school 1; Anna alone keeps 3, Brit alone keeps 4 (which Anna rejected) and 6.
  EXPECT_EQ(told.schools.counts, (AnswerCounts{{{1, 1}, {2, 0}}}));
  // Both decided on two: once both yes, once only Brit.
  EXPECT_EQ(told.decisions.counts, (AnswerCounts{{{1, 0}, {1, 0}}}));
  // Kept voxels: Anna 36 * 10 + 24 * 4, Brit 20 * 5 + 18 * 8 + 8 * 4; shared 18 * 8.
  EXPECT_EQ(told.voxels_a, 456);
  EXPECT_EQ(told.voxels_b, 276);
  EXPECT_EQ(told.voxels_both, 144);
  EXPECT_NEAR(told.voxel_dice, 288.0 / 732.0, 1e-12);
}

/// Whoever is called A: the same pairs in the same order, ratios inverted, differences with the other sign.
TEST(Agree, swapping_the_readers_mirrors) {
  const Agreement forth = agree(side_of(anna()), side_of(brit()));
  const Agreement back = agree(side_of(brit()), side_of(anna()));
  ASSERT_EQ(forth.rows.size(), back.rows.size());
  for (std::size_t i = 0; i < forth.rows.size(); ++i) {
    const AgreementRow& f = forth.rows[i];
    const AgreementRow& b = back.rows[i];
    EXPECT_EQ(f.school_a, b.school_b);
    EXPECT_EQ(f.school_b, b.school_a);
    EXPECT_EQ(f.first_time_utc, b.first_time_utc);
    EXPECT_EQ(f.n_pings_a, b.n_pings_b);
    EXPECT_EQ(f.status_a, b.status_b);
    if (std::isnan(f.dice)) continue;
    EXPECT_EQ(f.dice, b.dice);
    EXPECT_EQ(f.dice_low, b.dice_low);
    EXPECT_EQ(f.centre_distance_m, b.centre_distance_m);
    EXPECT_NEAR(f.volume_ratio * b.volume_ratio, 1.0, 1e-12);
    EXPECT_NEAR(f.volume_ratio_low * b.volume_ratio_high, 1.0, 1e-12);
    EXPECT_NEAR(f.backscatter_difference_db, -b.backscatter_difference_db, 1e-12);
    EXPECT_NEAR(f.backscatter_difference_low_db, -b.backscatter_difference_high_db, 1e-12);
  }
  EXPECT_EQ(forth.schools.counts[0][1], back.schools.counts[1][0]);
  EXPECT_EQ(forth.schools.kappa, back.schools.kappa);
  EXPECT_EQ(forth.voxel_dice, back.voxel_dice);
}

/// One school of one reader is two of the other: the larger piece is its pair, the other lies in it.
TEST(Agree, a_piece_tells_what_it_lies_in) {
  ObservationProduct pieces = example::empty("obs-0001", 12);
  example::add_school(pieces, 1, 0, 9, example::block(0, 0, 3, 10, 4));
  example::add_school(pieces, 2, 0, 9, example::block(0, 0, 3, 14, 8));
  const Agreement forth = agree(side_of(anna()), side_of(pieces));
  row_of(forth, "obs-0001/1", "obs-0001/2");
  EXPECT_EQ(row_of(forth, "", "obs-0001/1").lies_in, "obs-0001/1");
  const Agreement back = agree(side_of(pieces), side_of(anna()));
  row_of(back, "obs-0001/2", "obs-0001/1");
  EXPECT_EQ(row_of(back, "obs-0001/1", "").lies_in, "obs-0001/1");
}

/// Names shift when a file is added: only times, channels and samples tell what is the same. What only one has read is not
/// compared.
TEST(Agree, pings_match_by_time) {
  ScoreSide later = side_of(example::empty("obs-0001", 5, {61.0, 5.0}, example::kStart - 1'000'000'000'000));
  example::add_school(later.observations[0], 1, 0, 4, example::block(0, 0, 3, 10, 12));
  later.observations.push_back(anna());
  later.observations[1].observation = "obs-0002";
  const Agreement told = agree(side_of(anna()), later);
  EXPECT_EQ(told.pings, 12);
  ASSERT_EQ(told.rows.size(), 3U);
  for (const AgreementRow& row : told.rows) EXPECT_EQ(row.dice, 1.0);
  EXPECT_EQ(row_of(told, "obs-0001/1", "obs-0002/1").n_pings_both, 10);
  EXPECT_EQ(told.schools.kappa, 1.0);
}

TEST(Agree, other_surveys_are_refused) {
  EXPECT_TRUE(require_one_survey(side_of(anna()), "a", side_of(brit()), "b"));
  ScoreSide shifted = side_of(brit());
  for (PingNavigation& ping : shifted.observations[0].pings) ping.time += 500'000'000;
  const auto no_ping = require_one_survey(side_of(anna()), "a", shifted, "b");
  ASSERT_FALSE(no_ping);
  EXPECT_THAT(to_line(no_ping.error()), HasSubstr("no ping"));
  ScoreSide other = side_of(brit());
  other.observations[0].input_files[0].hash = "4567";
  const auto other_files = require_one_survey(side_of(anna()), "a", other, "b");
  ASSERT_FALSE(other_files);
  EXPECT_THAT(to_line(other_files.error()), HasSubstr("other raw files"));
}

/// What is drawn: every kept voxel of either in exactly one of three parts, in A's rows though B numbers its own otherwise.
TEST(Agree, parts_of_a_difference) {
  ObservationProduct turned = brit();
  std::vector<int>& channel = turned.grid->grid.channel;
  std::reverse(channel.begin(), channel.end());
  for (SchoolMask& m : turned.masks) {
    PingMask mask;
    for (auto run = m.mask.runs.rbegin(); run != m.mask.runs.rend(); ++run) {
      mask.runs.push_back({11 - run->row, run->first_sample, run->count});
    }
    mask.confidence = m.mask.confidence;
    m.mask = mask;
  }
  const auto parts = difference_products(side_of(anna()), side_of(turned));
  ASSERT_EQ(parts.size(), 1U);
  const auto part = [&](std::int64_t id, std::int64_t ping) {
    for (const SchoolMask& m : parts[0].masks) {
      if (m.school_id == id && m.ping_index == ping) return m.mask;
    }
    return PingMask{};
  };
  EXPECT_EQ(part(kInBoth, 0), example::block(0, 0, 3, 10, 6));
  EXPECT_EQ(part(kOnlyInA, 0), example::block(0, 0, 3, 16, 6));
  EXPECT_EQ(part(kOnlyInB, 0), example::block(2, 0, 2, 5, 4));
  EXPECT_EQ(part(kOnlyInB, 4), example::block(1, 0, 2, 30, 10)) << "Anna rejected it";
  EXPECT_TRUE(part(kInBoth, 9).empty());
  EXPECT_EQ(part(kOnlyInA, 9).voxels(), 36U + 24U);
  ASSERT_EQ(parts[0].school_pings.size(), 1U);
  EXPECT_EQ(parts[0].school_pings[0].ping_index, 8) << "the first of the two in which 60 voxels differ";
}

/// Readers who agree in every voxel are seen at a school too: A's strongest that was not rejected.
TEST(Agree, where_nothing_differs_the_strongest_school_is_seen) {
  ObservationProduct same = anna();
  for (SchoolPingRow& row : same.school_pings) {
    row.backscatter_m2 = row.school_id == 2 ? 9.0 : row.school_id == 3 && row.ping_index == 10 ? 5.0 : 1.0;
  }
  const auto parts = difference_products(side_of(same), side_of(same));
  ASSERT_EQ(parts.at(0).school_pings.size(), 1U);
  EXPECT_EQ(parts[0].school_pings[0].ping_index, 10);
  EXPECT_EQ(parts[0].school_pings[0].school_id, kInBoth);
  same.schools.clear();
  same.school_pings.clear();
  same.masks.clear();
  EXPECT_TRUE(difference_products(side_of(same), side_of(same)).at(0).school_pings.empty());
}

TEST(Agree, json_and_table) {
  const Agreement told = agree(side_of(anna()), side_of(brit()));
  const std::string text = agreement_json(told);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const json object = json::parse(text);
  EXPECT_EQ(object["schools"].size(), 4U);
  EXPECT_EQ(object["kappa_schools"]["counts"], (json{{1, 1}, {2, 0}}));
  EXPECT_TRUE(object["kappa_schools"]["kappa"].is_number());
  EXPECT_TRUE(object["kappa_decisions"]["kappa"].is_null()) << "Brit rejected nothing";
  EXPECT_THAT(csv_text(told.rows), HasSubstr("school_a,school_b,lies_in,first_time_utc,"));
  EXPECT_THAT(agreement_text(told), HasSubstr("Cohen's kappa"));
  EXPECT_FALSE(agreement_text(agree(ScoreSide{}, ScoreSide{})).empty());
}

}  // namespace
}  // namespace sonar
