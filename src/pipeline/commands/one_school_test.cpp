// SPDX-License-Identifier: Apache-2.0
// A school is one school: what a human selected of it, and what detection found of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_ground.h"
#include "pipeline/continued.h"

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
  return fold(lines, std::move(state), kSea.ground());
}

PropagateCommand reaching(std::int64_t pings) {
  PropagateCommand command = propagate_from(seed_a());
  command.reach = pings;
  return command;
}

/// "5>3 ..." by state number: what continues what.
std::string parts(const JournalState& state) {
  std::vector<const SchoolMasks*> masks;
  for (const auto& school : state.schools) masks.push_back(&school->masks);
  const std::vector<int> continues = continued(masks, 0.25);
  std::string text;
  for (std::size_t i = 0; i < continues.size(); ++i) {
    if (continues[i] < 0) continue;
    text += std::to_string(state.schools[i]->number) + ">" +
            std::to_string(state.schools[static_cast<std::size_t>(continues[i])]->number) + " ";
  }
  return text;
}

std::string ends(const JournalState& state, std::int64_t number) {
  for (const auto& school : state.schools) {
    if (school->number == number) return ended_at_reach(school->masks);
  }
  return "no such school";
}

std::size_t voxels_of_all(const JournalState& state, int ping) {
  std::size_t sum = 0;
  for (const auto& school : state.schools) {
    if (const auto* there = in_ping(school->masks, ping)) sum += there->mask.voxels();
  }
  return sum;
}

// A has 3 x 3 beams of 8 samples, B as many: 144 voxels a ping, whoever has them.
TEST(OneSchool, WhatDetectionFoundBeyondTheReachIsTheRestOfIt) {
  const JournalState state = after({{4, reaching(1)}});
  ASSERT_EQ(state.schools.size(), 3U);  // A's rest, B, and 3: pings 3 to 5 of A
  EXPECT_EQ(parts(state), "1>3 ");
  EXPECT_EQ(ends(state, 3), "both");
  for (int ping = 0; ping < kPings; ++ping) {
    EXPECT_EQ(voxels_of_all(state, ping), 144U) << ping;
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
}

TEST(OneSchool, EndsAreMarkedWhereTheReachAloneEndedIt) {
  const auto of = [](int ping, const PropagateCommand& command) { return ends(after({{ping, command}}, {}), 1); };
  EXPECT_EQ(of(4, reaching(2)), "both");
  EXPECT_EQ(of(1, reaching(2)), "last");  // before ping 0 there is nothing
  EXPECT_EQ(of(7, reaching(2)), "first");
  EXPECT_EQ(of(4, reaching(4)), "");
  EXPECT_EQ(of(4, reaching(-1)), "");
  PropagateCommand forwards = reaching(2);
  forwards.reach_backward = 0;  // not asked, so not ended by its reach
  EXPECT_EQ(of(4, forwards), "last");
  // Followed on, an end is what the last propagation made of it; the other stays.
  PropagateCommand on = forwards;
  on.seeds.clear();
  on.school = key_a(6);
  EXPECT_EQ(ends(after({{4, reaching(2)}, {6, on}}, {}), 1), "first");
  // Cut off by hand, it is the human's end.
  const SmallSea sea;
  EraseCommand erase;
  for (int row = 0; row < kFans * kBeams; ++row) erase.runs.push_back({row, 5, kSamples - 5});
  EXPECT_EQ(ends(after({{4, reaching(2)}, {6, erase}}, {}), 1), "first");
  // Split, each part has the end that is its.
  const JournalState split = after({{4, reaching(2)}, {4, SplitCommand{key_a(4), {}}}}, {});
  EXPECT_EQ(ends(split, 1), "first");
  EXPECT_EQ(ends(split, 2), "last");
  // And merged the farther ones.
  EXPECT_EQ(
      ends(after({{4, reaching(2)}, {4, SplitCommand{key_a(4), {}}}, {3, MergeCommand{{key_a(3), key_a(4)}}}}, {}), 1),
      "both");
}

TEST(OneSchool, StoppedByAHumanItEndsAtWhatWasReached) {
  const SmallSea sea;
  CommandGround ground = sea.ground();
  ground.on_step = [](std::int64_t ping, const PingMask&) { return ping != 6; };
  const JournalAct act{1, kBegin, "someone", ping_time(4), reaching(-1)};
  const auto watched = apply_watched(act, {}, ground);
  ASSERT_TRUE(watched);
  EXPECT_EQ(ends(watched->state, 1), "last");
  const auto again = apply(watched->act, {}, sea.ground());
  ASSERT_TRUE(again);
  EXPECT_EQ(ends(*again, 1), "last");
}

TEST(OneSchool, PartsAreTheSameInWhateverOrderTheyCame) {
  PropagateCommand early = reaching(1);
  PropagateCommand late = reaching(1);
  const Acts acts{{1, early}, {6, late}, {0, DetectCommand{2}}};
  std::vector<std::size_t> order{0, 1, 2};
  std::vector<std::string> told;
  do {
    Acts ordered;
    for (const std::size_t i : order) ordered.push_back(acts[i]);
    JournalState before = state_before_detection(masks_of(SmallSea::detected()));
    const JournalState state = after(ordered, std::move(before));
    // By first ping, for numbers go by the order of acts: 1 to 3, the rest with pings 0, 4 and 8, ...
    std::vector<const SchoolMasks*> masks;
    for (const auto& school : state.schools) masks.push_back(&school->masks);
    const std::vector<int> continues = continued(masks, 0.25);
    std::vector<std::string> one;
    for (std::size_t i = 0; i < masks.size(); ++i) {
      const int whole = continues[i];
      one.push_back(
          std::to_string(masks[i]->pings.front().ping_index) + "+" + std::to_string(masks[i]->pings.size()) +
          (whole < 0 ? "" : ">" + std::to_string(masks[static_cast<std::size_t>(whole)]->pings.front().ping_index)));
    }
    std::sort(one.begin(), one.end());
    std::string text;
    for (const std::string& part : one) text += part + " ";
    told.push_back(text);
    for (int ping = 0; ping < kPings; ++ping) EXPECT_EQ(voxels_of_all(state, ping), 144U);
  } while (std::next_permutation(order.begin(), order.end()));
  ASSERT_EQ(told.size(), 6U);
  // The click at ping 1 has 0 to 2, that at ping 6 has 5 to 7, detection the rest of A: one school, and B.
  for (const std::string& text : told) EXPECT_EQ(text, "0+3 0+9 3+3>0 5+3>0 ") << text;
}

TEST(OneSchool, SideBySidePartsStayTwoSchools) {
  // Detection took A and B for one.
  std::vector<SchoolMasks> joined(1);
  for (int i = 0; i < kPings; ++i) joined[0].pings.push_back({i, unite(block_mask(kA), block_mask(kB)), -50.0});
  PropagateCommand b = propagate_from({channel_at(2, 3), 47});
  b.reach = 1;
  const JournalState state = after({{4, reaching(1)}, {4, b}}, state_of_detected(std::move(joined)));
  ASSERT_EQ(state.schools.size(), 3U);
  EXPECT_EQ(parts(state), "1>2 ");
  for (const int ping : {3, 4, 5}) EXPECT_EQ(in_ping(state.schools[0]->masks, ping), nullptr);
}

TEST(OneSchool, WhatIsLeftRoundAHumansMaskIsNoSecondSchool) {
  // A brushed core would leave a rim; what was grown leaves nothing, however little of it was taken.
  const SmallSea sea;
  std::vector<SchoolMasks> wide(1);
  const Block round{0, 4, 1, 5, 26, 41};
  for (int i = 0; i < kPings; ++i) wide[0].pings.push_back({i, block_mask(round), -50.0});
  const JournalState state = after({{4, reaching(2)}}, state_of_detected(std::move(wide)));
  ASSERT_EQ(state.schools.size(), 2U);
  for (int ping = 2; ping <= 6; ++ping) EXPECT_EQ(voxels_of_all(state, ping), 72U) << ping;
  EXPECT_EQ(parts(state), "1>2 ");
}

TEST(OneSchool, ADeletedSelectionIsNoPart) {
  const JournalState state = after({{4, reaching(1)}, {4, DeleteCommand{key_a(4)}}});
  EXPECT_EQ(state.schools.size(), 2U);
  EXPECT_EQ(parts(state), "");
  // What was accepted keeps its voxels, so that nothing was selected out of it.
  const DecideCommand accept{{Decision{key_a(), "accepted", {}, {}}}, ""};
  EXPECT_EQ(parts(after({{0, accept}, {4, reaching(1)}})), "");
}

}  // namespace
}  // namespace sonar
