// SPDX-License-Identifier: Apache-2.0
// A school is one school: what a human selected of it, and what detection found of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/school_totals.h"
#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"
#include "pipeline/journal/continued.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

using Acts = std::vector<std::pair<int, Command>>;

JournalState after(const Acts& acts, JournalState state = SmallSea::detected()) {
  static const SmallSea kSea;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : acts) {
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
  }
  return fold(lines, std::move(state), kSea.context());
}

PropagateCommand reaching(std::int64_t pings, const SeedKey& seed = seed_a()) {
  PropagateCommand command = propagate_from(seed);
  command.reach = pings;
  return command;
}

/// The state's tables, with a voxel for a square metre of backscatter.
ObservationProduct tables_of(const JournalState& state) {
  ObservationProduct product;
  product.observation = "obs-0001";
  std::vector<SchoolMasks> schools = masks_of(state);
  for (std::size_t i = 0; i < schools.size(); ++i) schools[i].decided.school_id = state.schools[i]->number;
  name_parts(schools, product.observation);
  for (const SchoolMasks& school : schools) {
    SchoolRow& row = product.schools.emplace_back(school.decided);
    row.observation = product.observation;
    double sum = 0.0;
    for (const auto& there : school.pings) {
      SchoolPingRow& ping = product.school_pings.emplace_back();
      ping.observation = product.observation;
      ping.school_id = row.school_id;
      ping.ping_index = there.ping_index;
      ping.backscatter_total_m2 = static_cast<double>(there.mask.voxels());
      sum += ping.backscatter_total_m2;
    }
    row.backscatter_total_m2 = sum / static_cast<double>(school.pings.size());
  }
  return product;
}

double total(const JournalState& state) {
  const ObservationProduct product = tables_of(state);
  return total_backscatter_m2(counted_schools({&product, 1}));
}

/// "1>3 ...": what continues what.
std::string parts(const JournalState& state) {
  std::string text;
  for (const SchoolRow& row : tables_of(state).schools) {
    if (row.continues.empty()) continue;
    text += std::to_string(row.school_id) + ">" + row.continues.substr(row.continues.find('/') + 1) + " ";
  }
  return text;
}

std::string ends(const JournalState& state, std::int64_t number) {
  for (const auto& school : state.schools) {
    if (school->number == number) return ended_at_reach(school->masks);
  }
  return "no such school";
}

// A has 3 x 3 beams of 8 samples, B as many: 72 voxels a ping each.
constexpr double kOne = 72.0;
constexpr double kBoth = 144.0;

TEST(OneSchool, WhatDetectionFoundBeyondTheReachIsTheRestOfIt) {
  const JournalState state = after({{4, reaching(1)}});
  ASSERT_EQ(state.schools.size(), 3U);  // A's rest, B, and 3: pings 3 to 5 of A
  EXPECT_EQ(parts(state), "1>3 ");
  EXPECT_EQ(ends(state, 3), "both");
  EXPECT_EQ(total(state), kBoth);
  EXPECT_EQ(school_count(tables_of(state)), 2);
  for (int ping = 0; ping < kPings; ++ping) {
    EXPECT_NE(in_ping(state.schools[0]->masks, ping) != nullptr, in_ping(state.schools[2]->masks, ping) != nullptr);
  }
  // Carried on as far as it goes, nothing is left to be a part.
  PropagateCommand on = propagate_from(seed_a());
  on.seeds.clear();
  on.school = key_a(4);
  const JournalState whole = after({{4, reaching(1)}, {4, on}});
  EXPECT_EQ(parts(whole), "");
  EXPECT_EQ(ends(whole, 3), "");
  EXPECT_EQ(whole.schools.size(), 2U);
  EXPECT_EQ(total(whole), kBoth);
}

// What is known beyond the reach need not be asked for; a rejected part is none.
TEST(OneSchool, AnEndBeyondWhichItIsKnownIsNotOpen) {
  const JournalState state = after({{4, reaching(1)}});
  EXPECT_EQ(open_ends(state, *state.schools[2]), "");
  EXPECT_EQ(open_ends(state, *state.schools[0]), "");
  const DecideCommand reject{{Decision{key_a(), "rejected", {}, {}}}, ""};
  const JournalState rejected = after({{4, reaching(1)}, {0, reject}});
  EXPECT_EQ(open_ends(rejected, *rejected.schools[2]), "both");
  const JournalState undetected = after({{4, reaching(1)}}, {});
  EXPECT_EQ(open_ends(undetected, *undetected.schools[0]), "both");
  std::vector<SchoolMasks> early(1);
  for (int i = 0; i < 5; ++i) early[0].pings.push_back({i, block_mask(kA), -50.0});
  const JournalState half = after({{4, reaching(1)}}, state_of_detected(std::move(early)));
  ASSERT_EQ(half.schools.size(), 2U);
  EXPECT_EQ(open_ends(half, *half.schools[1]), "last");
}

// Whatever came first, fish are counted once: in every ping A and B, or one of them where nobody looked for the other.
TEST(OneSchool, TotalsDoNotRiseWithTheOrderOfClicksDetectionAndMerge) {
  const Acts acts{{1, reaching(1)}, {6, reaching(1)}, {0, DetectCommand{2}}, {4, MergeCommand{{key_a(4), key_b(4)}}}};
  std::vector<std::size_t> order{0, 1, 2, 3};
  int orders = 0;
  do {
    Acts ordered;
    std::string said;
    for (const std::size_t i : order) {
      ordered.push_back(acts[i]);
      said += command_name(acts[i].second) + " ";
    }
    const JournalState state = after(ordered, state_before_detection(masks_of(SmallSea::detected())));
    EXPECT_EQ(total(state), kBoth) << said;
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(orders, 24);
  // Without the merge they are two schools, the click's parts and the rest of A being one.
  for (const Acts& two :
       {Acts{acts[0], acts[1], acts[2]}, Acts{acts[2], acts[1], acts[0]}, Acts{acts[1], acts[2], acts[0]}}) {
    const JournalState state = after(two, state_before_detection(masks_of(SmallSea::detected())));
    EXPECT_EQ(school_count(tables_of(state)), 2);
    EXPECT_EQ(total(state), kBoth);
  }
  // By hand alone, as far as it was carried.
  EXPECT_EQ(total(after({acts[0]}, {})), kOne);
}

// A merge takes what a click left of a school, or the click's part alone: the fish of the others are its too.
TEST(OneSchool, MergedInPartItIsOneSchoolAllTheSame) {
  for (const int ping : {0, 4}) {
    const JournalState state = after({{4, reaching(0)}, {4, MergeCommand{{key_a(ping), key_b(4)}}}});
    EXPECT_EQ(school_count(tables_of(state)), 1) << ping;
    EXPECT_EQ(total(state), kBoth) << ping;
  }
}

TEST(OneSchool, SelectedSideBySideOutOfOneTheyCountOnce) {
  // Detection took A and B for one.
  std::vector<SchoolMasks> joined(1);
  for (int i = 0; i < kPings; ++i) joined[0].pings.push_back({i, unite(block_mask(kA), block_mask(kB)), -50.0});
  const Acts acts{{4, reaching(1)}, {4, reaching(1, {channel_at(2, 3), 47})}};
  const JournalState state = after(acts, state_of_detected(joined));
  ASSERT_EQ(state.schools.size(), 3U);
  EXPECT_EQ(total(state), kBoth);
  // Where no ping shows them as one any more, they are two.
  const Acts whole{{4, reaching(-1)}, {4, reaching(-1, {channel_at(2, 3), 47})}};
  EXPECT_EQ(school_count(tables_of(after(whole, state_of_detected(joined)))), 2);
  EXPECT_EQ(total(after(whole, state_of_detected(joined))), kBoth);
}

TEST(OneSchool, ABrushedPieceIsAPart) {
  BrushCommand stroke;
  for (int beam = kA.first_beam; beam <= kA.last_beam; ++beam) stroke.runs.push_back({channel_at(2, beam), 30, 8});
  const JournalState state = after({{4, stroke}});
  ASSERT_EQ(state.schools.size(), 3U);
  EXPECT_EQ(total(state), kBoth);
}

TEST(OneSchool, AnotherSchoolThatTouchesItIsNone) {
  // A sample of B's eight is in what was found of A: an eighth of the smaller one.
  std::vector<SchoolMasks> wide(1);
  for (int i = 0; i < kPings; ++i) wide[0].pings.push_back({i, block_mask({1, 3, 2, 4, 30, 44}), -50.0});
  const JournalState state = after({{4, reaching(1, {channel_at(2, 3), 47})}}, state_of_detected(std::move(wide)));
  ASSERT_EQ(state.schools.size(), 2U);
  EXPECT_EQ(parts(state), "");
}

// Numbers: 1 the rest of A, 2 B, 3 what was clicked, 4 what was split off.
TEST(OneSchool, WhatAHumanSplitsOffIsAnother) {
  const SplitCommand in_time{key_a(), {}};
  const JournalState before_it = after({{4, reaching(1)}, {2, in_time}});
  EXPECT_EQ(school_count(tables_of(before_it)), 3);
  EXPECT_EQ(parts(before_it), "4>3 ") << "pings 2 and later lie about what was clicked";
  const JournalState behind_it = after({{4, reaching(1)}, {7, in_time}});
  EXPECT_EQ(school_count(tables_of(behind_it)), 3);
  EXPECT_EQ(parts(behind_it), "1>3 ");
  const JournalState itself = after({{4, reaching(1)}, {4, SplitCommand{key_a(4), {}}}});
  EXPECT_EQ(school_count(tables_of(itself)), 3);
  EXPECT_EQ(parts(itself), "1>3 ");
  // Detection took A and B for one.
  std::vector<SchoolMasks> joined(1);
  for (int i = 0; i < kPings; ++i) joined[0].pings.push_back({i, unite(block_mask(kA), block_mask(kB)), -50.0});
  const Acts in_space{{4, reaching(0)}, {2, SplitCommand{key_a(), SeedKey{channel_at(2, 3), 47}}}};
  const JournalState apart = after(in_space, state_of_detected(joined));
  EXPECT_EQ(school_count(tables_of(apart)), 2);
  EXPECT_EQ(parts(apart), "1>2 ");
  EXPECT_EQ(total(apart), kBoth);
}

// A click upon two that were found keeps them together until it is split between them.
TEST(OneSchool, SplitBetweenTwoThatWereFoundEachHasItsOwnRest) {
  std::vector<SchoolMasks> two(2);
  for (int i = 0; i < kPings; ++i) two[i < 4 ? 0 : 1].pings.push_back({i, block_mask(kA), -50.0});
  const JournalState state =
      after({{4, reaching(1)}, {4, SplitCommand{key_a(4), {}}}}, state_of_detected(std::move(two)));
  EXPECT_EQ(parts(state), "1>3 2>4 ");
}

/// [ping] voxels of all schools together: what backscatter of a ping stands for.
std::vector<std::size_t> voxels_by_ping(const JournalState& state) {
  std::vector<std::size_t> voxels(kPings);
  for (const auto& school : state.schools) {
    for (const auto& there : school->masks.pings) {
      voxels[static_cast<std::size_t>(there.ping_index)] += there.mask.voxels();
    }
  }
  return voxels;
}

/// "1:0-8 2:0-8": who is in which pings.
std::string tracks(const JournalState& state) {
  std::string text;
  for (const auto& school : state.schools) {
    text += std::to_string(school->number) + ":";
    const auto& pings = school->masks.pings;
    for (std::size_t i = 0; i < pings.size(); ++i) {
      const bool begins = i == 0 || pings[i - 1].ping_index + 1 != pings[i].ping_index;
      const bool ends = i + 1 == pings.size() || pings[i + 1].ping_index != pings[i].ping_index + 1;
      if (begins) text += (i == 0 ? "" : ",") + std::to_string(pings[i].ping_index);
      if (ends) text += "-" + std::to_string(pings[i].ping_index);
    }
    text += " ";
  }
  return text;
}

HandOverCommand handing(const SchoolKey& school, std::optional<SchoolKey> to, int first, int last) {
  return {school, to, ping_time(first), ping_time(last)};
}

// Whoever has a voxel, it is in one school before and after: in every ping as many as before.
TEST(OneSchool, TracksAreCutJoinedAndHandedOverWithoutLoss) {
  const std::vector<std::pair<Acts, std::string>> cases{
      {{{4, SplitCommand{key_a(), {}}}}, "1:0-3 2:0-8 3:4-8 "},
      {{{4, SplitCommand{key_a(), {}}}, {4, MergeCommand{{key_a(), key_a(4)}}}}, "1:0-8 2:0-8 "},
      {{{4, handing(key_a(), key_b(), 3, 5)}}, "1:0-2,6-8 2:0-8 "},
      {{{4, handing(key_a(), {}, 3, 5)}}, "1:0-2,6-8 2:0-8 3:3-5 "},
      {{{4, handing(key_a(), {}, 3, 5)}, {4, handing(key_a(4), key_a(0), 3, 5)}}, "1:0-8 2:0-8 "},
      {{{4, handing(key_a(), key_b(), 0, 8)}}, "2:0-8 "},
      {{{4, handing(key_a(), key_b(), -9, 99)}}, "2:0-8 "},
      {{{4, SplitCommand{key_a(), {}}}, {4, handing(key_a(4), key_b(), 4, 4)}}, "1:0-3 2:0-8 3:5-8 "}};
  const auto before = voxels_by_ping(SmallSea::detected());
  EXPECT_EQ(before, std::vector<std::size_t>(kPings, 144));
  for (const auto& [acts, expected] : cases) {
    const JournalState state = after(acts);
    EXPECT_TRUE(state.notes.empty()) << expected;
    EXPECT_EQ(tracks(state), expected);
    EXPECT_EQ(voxels_by_ping(state), before) << expected;
  }
  // What is cut and joined is what it was, voxel by voxel.
  const JournalState again = after(cases[1].first);
  const JournalState was = SmallSea::detected();
  for (std::size_t i = 0; i < again.schools[0]->masks.pings.size(); ++i) {
    EXPECT_EQ(again.schools[0]->masks.pings[i].mask, was.schools[0]->masks.pings[i].mask) << i;
  }
}

// Fish that one click had and another one gets are not what detection found of the first any more.
TEST(OneSchool, WhatIsHandedOverIsAPartOfTheOtherAlone) {
  // 1 is the rest of A, found in all pings, 3 what was clicked; 2 gets a piece of the rest.
  const JournalState given = after({{4, reaching(1)}, {4, handing(key_a(8), key_b(), 6, 7)}});
  EXPECT_EQ(parts(given), "1>3 ") << "B is no part of A, though it has some of what was found of A";
  EXPECT_EQ(school_count(tables_of(given)), 2);
  // Between parts of one school nothing changes.
  const JournalState within = after({{4, reaching(1)}, {4, handing(key_a(8), key_a(4), 6, 7)}});
  EXPECT_EQ(school_count(tables_of(within)), 2);
  EXPECT_EQ(total(within), kBoth);
}

// Where a school's propagation had its reach is nothing that a piece from its middle brings along.
TEST(OneSchool, AMiddlePieceLeavesTheOthersEndsAsTheyAre) {
  const SchoolKey b = key_b(4);
  const Acts clicked{{4, reaching(2)}, {4, reaching(1, {b.channel, b.sample})}};
  ASSERT_EQ(ends(after(clicked), 4), "both");
  Acts acts = clicked;
  acts.push_back({4, handing(key_a(4), b, 4, 4)});
  EXPECT_EQ(ends(after(acts), 4), "both");
  acts.back() = {4, handing(key_a(4), b, 2, 6)};
  EXPECT_EQ(ends(after(acts), 4), "both") << "and the ends of what is given whole are its own";
}

TEST(OneSchool, ADeletedOrRefusedSelectionIsNoPart) {
  const JournalState state = after({{4, reaching(1)}, {4, DeleteCommand{key_a(4)}}});
  EXPECT_EQ(state.schools.size(), 2U);
  EXPECT_EQ(parts(state), "");
  // What was accepted keeps its voxels, so that nothing was selected out of it.
  const DecideCommand accept{{Decision{key_a(), "accepted", {}, {}}}, ""};
  EXPECT_EQ(parts(after({{0, accept}, {4, reaching(1)}})), "");
  // A rejected part is none of the school's.
  const DecideCommand reject{{Decision{key_a(4), "rejected", {}, {}}}, ""};
  EXPECT_EQ(total(after({{4, reaching(1)}, {4, reject}})), kBoth);
}

}  // namespace
}  // namespace sonar
