// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_cause.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "io/atomic_file.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

/// One false school, the same mask in ping 0 .. 3, over a truth without schools.
struct Sides {
  ScoreSide found, truth;
};

Sides sides_of(const PingMask& mask) {
  ObservationProduct found = example::empty("obs-0009", 6);  // another name, the same times
  example::add_school(found, 1, 0, 3, mask);
  Sides sides;
  sides.found.observations = {found};
  sides.truth.observations = {example::empty("obs-0001", 6)};
  sides.truth.company.emplace();
  return sides;
}

FalseSchool only_false_school(const Sides& sides) {
  const Score result = score(sides.found, sides.truth);
  EXPECT_EQ(result.false_schools.size(), 1U);
  return result.false_schools.empty() ? FalseSchool{} : result.false_schools[0];
}

void add(Sides& sides, int ping, const CompanyBox& box) { (*sides.truth.company)[{"obs-0001", ping}].push_back(box); }

/// 2 beams of fan 1, samples 10 .. 19: 20 voxels a ping, 80 in all.
PingMask twenty() { return example::block(1, 1, 2, 10, 10); }

TEST(ScoreCause, unknown_without_the_table_and_none_in_empty_water) {
  Sides sides = sides_of(twenty());
  EXPECT_EQ(only_false_school(sides).cause, "none");
  EXPECT_EQ(only_false_school(sides).cause_share, 0.0);
  sides.truth.company.reset();
  EXPECT_EQ(only_false_school(sides).cause, "unknown");
  EXPECT_TRUE(std::isnan(only_false_school(sides).cause_share));
}

TEST(ScoreCause, the_kind_that_holds_most_worked_by_hand) {
  Sides sides = sides_of(twenty());
  for (int ping = 0; ping < 4; ++ping) {
    add(sides, ping, {"plume", 0, 1, 2, 3, 0, 59});  // one of two beams: 10 of 20
    // Two boxes of a kind over the same voxels: samples 10 .. 15 of both beams, 12 of 20; they count once.
    add(sides, ping, {"seabed", 1, 1, 0, 3, 8, 15});
    add(sides, ping, {"seabed", 1, 2, 0, 3, 12, 15});
    add(sides, ping, {"layer", 2, 2, 0, 3, 0, 59});  // another fan
  }
  add(sides, 5, {"surface", 0, 2, 0, 3, 0, 59});  // a ping without the school
  EXPECT_EQ(only_false_school(sides).cause, "seabed");
  EXPECT_NEAR(only_false_school(sides).cause_share, 0.6, 1e-12);

  // Without company in two of the four pings the seabed holds 24 of 80.
  sides.truth.company->erase({"obs-0001", 2});
  sides.truth.company->erase({"obs-0001", 3});
  EXPECT_EQ(only_false_school(sides).cause, "none");
  EXPECT_NEAR(only_false_school(sides).cause_share, 0.3, 1e-12);
}

TEST(ScoreCause, among_equals_the_smaller_boxes) {
  Sides sides = sides_of(twenty());
  for (int ping = 0; ping < 4; ++ping) {
    add(sides, ping, {"surface", 0, 2, 0, 3, 0, 59});
    add(sides, ping, {"hull_bubbles", 1, 1, 1, 2, 5, 25});
    add(sides, ping, {"layer", 1, 1, 0, 3, 0, 59});
  }
  EXPECT_EQ(only_false_school(sides).cause, "hull_bubbles");
  EXPECT_EQ(only_false_school(sides).cause_share, 1.0);
}

/// Boxes are in the truth's grid; a result that numbers its rows from the other side meets them by channel.
TEST(ScoreCause, grids_that_number_rows_differently_meet_by_channel) {
  Sides sides = sides_of(example::block(0, 0, 4, 10, 10));
  std::vector<int>& channel = sides.found.observations[0].grid->grid.channel;
  channel = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8};  // the truth's fan 2 is this one's fan 0
  for (int ping = 0; ping < 4; ++ping) {
    add(sides, ping, {"seabed", 0, 0, 0, 3, 0, 59});
    add(sides, ping, {"surface", 2, 2, 0, 3, 0, 59});
  }
  EXPECT_EQ(only_false_school(sides).cause, "surface");
}

/// The share against a count of single voxels, for boxes and masks at random.
TEST(ScoreCause, agrees_with_a_count_of_single_voxels) {
  std::mt19937 random(20260);
  const auto draw = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
  for (int round = 0; round < 60; ++round) {
    PingMask mask;
    for (int i = 0; i < 3; ++i) {
      const int beam = draw(0, 2);
      mask = unite(mask, example::block(draw(0, 2), beam, draw(1, 4 - beam), draw(0, 30), draw(1, 25)));
    }
    Sides sides = sides_of(mask);
    std::map<std::string, std::set<std::tuple<int, int, int>>> inside;  // kind -> (ping, row, sample)
    for (int ping = 0; ping < 4; ++ping) {
      for (int i = draw(0, 6); i > 0; --i) {
        const int fan = draw(0, 2), beam = draw(0, 3), sample = draw(0, 50);
        const CompanyBox box{
            draw(0, 1) == 0 ? "plume" : "layer", fan, draw(fan, 2), beam, draw(beam, 3), sample, draw(sample, 59)};
        add(sides, ping, box);
        for (const sonar::Run& run : mask.runs) {
          for (int s = run.first_sample; s < run.end(); ++s) {
            const int f = run.row / example::kBeams, b = run.row % example::kBeams;
            const bool in = f >= box.first_fan && f <= box.last_fan && b >= box.first_beam && b <= box.last_beam &&
                            s >= box.first_sample && s <= box.last_sample;
            if (in) inside[box.kind].insert({ping, run.row, s});
          }
        }
      }
    }
    std::size_t most = 0;
    for (const auto& [kind, voxels] : inside) most = std::max(most, voxels.size());
    const double share = static_cast<double>(most) / static_cast<double>(4 * mask.voxels());
    const FalseSchool school = only_false_school(sides);
    ASSERT_NEAR(school.cause_share, share, 1e-12) << "round " << round;
    ASSERT_EQ(school.cause == "none", share < 0.5) << "round " << round;
    if (school.cause != "none") {
      ASSERT_EQ(inside[school.cause].size(), most) << "round " << round;
    }
  }
}

TEST(ScoreCause, is_told_in_json_and_text) {
  Sides sides = sides_of(twenty());
  for (int ping = 0; ping < 4; ++ping) add(sides, ping, {"other_sounder", 1, 1, 0, 3, 0, 59});
  const Score result = score(sides.found, sides.truth);
  const nlohmann::json told = nlohmann::json::parse(score_json(result));
  EXPECT_EQ(told["false_schools"][0]["cause"], "other_sounder");
  EXPECT_EQ(told["false_schools"][0]["cause_share"], 1.0);
  EXPECT_EQ(told["summary"]["false_by_cause"]["other_sounder"], 1);
  EXPECT_NE(score_text(result).find("false schools by cause: other_sounder 1"), std::string::npos);
}

TEST(ScoreCause, company_is_read_from_the_truth_folder) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_product(example::empty("obs-0001", 6), folder.path() / "obs-0001.nc"));
  EXPECT_FALSE(read_truth_side(folder.path())->company.has_value());
  const std::string header =
      "observation,ping_index,kind,first_fan,last_fan,first_beam,last_beam,first_sample,last_sample,backscatter_m2,"
      "SYNTHETIC\n";
  ASSERT_TRUE(write_file(folder.path() / "company.csv",
                         header + "obs-0001,2,seabed,0,1,2,3,40,50,,yes\nobs-0001,2,plume,2,2,0,1,5,9,0.25,yes\n"));
  const auto side = read_truth_side(folder.path());
  ASSERT_TRUE(side && side->company);
  const auto& boxes = side->company->at({"obs-0001", 2});
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[1].kind, "plume");
  EXPECT_EQ(boxes[0].last_beam, 3);
  EXPECT_EQ(boxes[1].last_sample, 9);
  ASSERT_TRUE(write_file(folder.path() / "company.csv", header + "obs-0001,2,seabed,zero,1,2,3,40,50,,yes\n"));
  EXPECT_FALSE(read_truth_side(folder.path()));
}

}  // namespace
}  // namespace sonar
