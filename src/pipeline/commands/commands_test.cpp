// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_commands.h"
#include "pipeline/commands/test_context.h"
#include "school/grow/mask_edit.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

constexpr int kSizeA = 3 * 3 * 8;

const PingMask& mask_of(const JournalState& state, std::size_t school, std::int64_t ping) {
  return in_ping(state.schools[school]->masks, ping)->mask;
}

TEST(Commands, EveryCommandChangesTheStateAndUndoRestoresIt) {
  const SmallSea sea;
  const std::string before = told(SmallSea::detected());
  for (const auto& [ping, command] : every_command()) {
    const JournalLine act = line(1, ping, command);
    JournalLine undo{2, 0, "", "undo", 0, JsonValue(nlohmann::json{{"target", 1}})};
    JournalLine redo{3, 0, "", "redo", 0, JsonValue(nlohmann::json{{"target", 1}})};
    const auto fold_all = [&](const std::vector<JournalLine>& lines) {
      return fold(effective_lines(lines), SmallSea::detected(), sea.context());
    };
    const JournalState done = fold_all({act});
    for (const Diagnostic& note : done.notes) EXPECT_NE(note.code, DiagnosticCode::decision_lost) << note.text;
    EXPECT_NE(told(done), before) << act.command;
    EXPECT_EQ(told(fold_all({act, undo})), before) << act.command;
    EXPECT_EQ(told(fold_all({act, undo, redo})), told(done)) << act.command;
  }
}

TEST(Commands, NoVoxelEverBelongsToTwoSchools) {
  const SmallSea sea;
  JournalState state = SmallSea::detected();
  for (const auto& [ping, command] : every_command()) {
    const auto next = apply({1, 0, "", ping_time(ping), command}, state, sea.context());
    if (next) state = *next;
    for (std::size_t a = 0; a < state.schools.size(); ++a) {
      for (std::size_t b = a + 1; b < state.schools.size(); ++b) {
        for (const auto& there : state.schools[a]->masks.pings) {
          const auto* other = in_ping(state.schools[b]->masks, there.ping_index);
          ASSERT_TRUE(other == nullptr || overlap(there.mask, other->mask) == 0) << command_name(command);
        }
      }
    }
  }
}

TEST(Commands, PropagationTakesTheDetectedSchoolsPlace) {
  const JournalState state = after({{4, propagate_from(seed_a())}});
  ASSERT_EQ(state.schools.size(), 2U);  // B, and A as the human's
  EXPECT_EQ(state.schools[0]->number, 2);
  EXPECT_EQ(state.schools[1]->masks.decided.origin, "manual");
  EXPECT_EQ(state.schools[1]->masks.pings.size(), static_cast<std::size_t>(kPings));
  EXPECT_EQ(mask_of(state, 1, 0).voxels(), static_cast<std::size_t>(kSizeA));
}

TEST(Commands, PropagationReachesAsFarAsItWasTold) {
  PropagateCommand stopped = propagate_from(seed_a());
  stopped.reach_backward = 1;
  stopped.reach_forward = 2;
  const JournalState state = after({{4, stopped}});
  ASSERT_EQ(state.schools.size(), 3U);  // the detected A keeps the pings that were not reached
  const auto& pings = state.schools[2]->masks.pings;
  ASSERT_EQ(pings.size(), 4U);
  EXPECT_EQ(pings.front().ping_index, 3);
  EXPECT_EQ(pings.back().ping_index, 6);
  EXPECT_EQ(state.schools[0]->masks.pings.size(), 5U);
}

TEST(Commands, CarryingOnReplacesOneSideAndKeepsTheOther) {
  const RunKey stroke{channel_at(2, 5), 30, 8};  // one more beam by hand in ping 4
  PropagateCommand on;
  on.school = key_a(4);
  on.reach_backward = 0;
  const JournalState state = after({{4, BrushCommand{{stroke}, key_a(4)}}, {4, on}});
  ASSERT_EQ(state.schools.size(), 2U);
  EXPECT_EQ(state.schools[0]->masks.pings.size(), static_cast<std::size_t>(kPings));
  EXPECT_EQ(mask_of(state, 0, 3), block_mask(kA));
  EXPECT_EQ(mask_of(state, 0, 4).voxels(), static_cast<std::size_t>(kSizeA + 8));
  EXPECT_EQ(mask_of(state, 0, 5).voxels(), static_cast<std::size_t>(kSizeA));  // the water there is no fish
  EXPECT_EQ(state.schools[0]->masks.decided.status, "corrected");
}

TEST(Commands, GrowingAddsAndTakesAway) {
  GrowCommand join;
  join.to = GrowTo::add;
  join.school = key_b(3);
  join.seeds = {seed_a()};
  const JournalState joined = after({{3, join}});
  EXPECT_EQ(mask_of(joined, 1, 3).voxels(), static_cast<std::size_t>(2 * kSizeA));
  EXPECT_EQ(in_ping(joined.schools[0]->masks, 3), nullptr);
  GrowCommand away = join;
  away.to = GrowTo::take_away;
  const JournalState apart = after({{3, join}, {3, away}});
  EXPECT_EQ(mask_of(apart, 1, 3), block_mask(kB));
}

TEST(Commands, BrushTakesVoxelsFromWhoeverHadThem) {
  const RunKey stroke{channel_at(2, 3), 36, 10};  // two samples of A, two of B
  const JournalState state = after({{3, BrushCommand{{stroke}, key_a(3)}}});
  EXPECT_EQ(mask_of(state, 0, 3).voxels(), static_cast<std::size_t>(kSizeA + 8));
  EXPECT_EQ(mask_of(state, 1, 3).voxels(), static_cast<std::size_t>(kSizeA - 2));
  EXPECT_EQ(mask_of(state, 1, 2), block_mask(kB));
}

TEST(Commands, HoleIsErasedFilledAndGone) {
  const EraseCommand hole{{{channel_at(2, 3), 33, 2}}, key_a(3)};
  const SchoolKey rim{ping_time(3), channel_at(1, 2), 30};
  const JournalState open = after({{3, hole}});
  EXPECT_EQ(mask_of(open, 0, 3).voxels(), static_cast<std::size_t>(kSizeA - 2));
  const JournalState filled = after({{3, hole}, {3, ReshapeCommand{Reshaping::fill_holes, rim, false}}});
  EXPECT_EQ(mask_of(filled, 0, 3).voxels(), static_cast<std::size_t>(kSizeA));
}

TEST(Commands, MergeAndSplitInTimeAndInSpace) {
  const MergeCommand merge{{key_a(), key_b()}};
  const JournalState one = after({{3, merge}});
  ASSERT_EQ(one.schools.size(), 1U);
  EXPECT_EQ(mask_of(one, 0, 8), unite(block_mask(kA), block_mask(kB)));

  const JournalState halves = after({{3, merge}, {3, SplitCommand{key_a(), {}}}});
  ASSERT_EQ(halves.schools.size(), 2U);
  EXPECT_EQ(halves.schools[0]->masks.pings.size(), 3U);
  EXPECT_EQ(halves.schools[1]->masks.pings.front().ping_index, 3);

  const JournalState again = after({{3, merge}, {3, SplitCommand{key_a(), SeedKey{channel_at(2, 3), 47}}}});
  ASSERT_EQ(again.schools.size(), 2U);
  for (int ping = 0; ping < kPings; ++ping) {
    EXPECT_EQ(mask_of(again, 0, ping), block_mask(kA));
    EXPECT_EQ(mask_of(again, 1, ping), block_mask(kB));
  }
}

TEST(Commands, DecisionsFillTheHumanColumns) {
  const JournalState state = after({{3, DecideCommand{{decision(key_b(5), "accepted", "herring", "dense")}, ""}}});
  const SchoolRow& row = state.schools[1]->masks.decided;
  EXPECT_EQ(row.status, "accepted");
  EXPECT_EQ(row.species, "herring");
  EXPECT_EQ(row.comment, "dense");
  EXPECT_EQ(row.operator_name, "someone");
  EXPECT_EQ(row.decided_utc, kBegin + kSecondNs);
  EXPECT_EQ(row.origin, "automatic");
  EXPECT_EQ(state.schools[0]->masks.decided.status, "unreviewed");
}

TEST(Commands, DecisionWithoutItsSchoolIsListedAndNeverMoved) {
  SchoolKey nowhere = key_a();
  nowhere.sample = 41;
  const auto bulk = DecideCommand{{decision(nowhere, "accepted"), decision(key_b(), "rejected")}, "all"};
  const JournalState state = after({{0, bulk}, {0, DeleteCommand{nowhere}}});
  ASSERT_EQ(state.notes.size(), 2U);
  for (const Diagnostic& note : state.notes) EXPECT_EQ(note.code, DiagnosticCode::decision_lost);
  EXPECT_EQ(state.schools[0]->masks.decided.status, "unreviewed");
  EXPECT_EQ(state.schools[1]->masks.decided.status, "rejected");
  EXPECT_EQ(state.schools.size(), 2U);
}

TEST(Commands, BadPingsKeepTheirMasksButAreNotMeasured) {
  const JournalState state = after({{0, BadPingsCommand{ping_time(2), ping_time(4)}}});
  EXPECT_EQ(state.schools[0]->masks.pings.size(), 9U);
  const auto measured = measured_masks_of(state, SmallSea{}.context().times);
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_EQ(measured[0].pings.size(), 6U);
  for (const auto& there : measured[0].pings) EXPECT_TRUE(there.ping_index < 2 || there.ping_index > 4);
}

TEST(Commands, MarksAndBadPingsAreTakenBack) {
  const SmallSea sea;
  const auto lines_of = [](const std::vector<Command>& commands) {
    std::vector<JournalLine> lines;
    for (const Command& command : commands)
      lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, 3, command));
    return lines;
  };
  const EventCommand trawl{"trawl", ping_time(2), "haul 12"};
  const EventCommand noise{"noise", ping_time(2), ""};
  const auto lines =
      lines_of({trawl, noise, BadPingsCommand{ping_time(2), ping_time(6)}, RemoveEventCommand{trawl},
                GoodPingsCommand{ping_time(4), ping_time(4)}, GoodPingsCommand{ping_time(6), ping_time(6)}});
  for (const JournalLine& one : lines) {
    const auto read = act_of(one);
    ASSERT_TRUE(read) << one.command << ": " << read.error().text;
    EXPECT_EQ(line_of(*read).args, one.args);
    EXPECT_EQ(line_of(*read).command, one.command);
  }
  const JournalState state = fold(lines, SmallSea::detected(), sea.context());
  ASSERT_EQ(state.events.size(), 1U);
  EXPECT_EQ(state.events[0], noise);
  for (int ping = 0; ping < 9; ++ping) {
    EXPECT_EQ(is_bad(state, ping_time(ping)), ping == 2 || ping == 3 || ping == 5) << ping;
  }
  // What is not there is told, and nothing else changes.
  const JournalState again = fold(lines_of({RemoveEventCommand{trawl}}), state, sea.context());
  EXPECT_EQ(again.events.size(), 1U);
  ASSERT_FALSE(again.notes.empty());
  EXPECT_THAT(again.notes.back().text, testing::HasSubstr("there is no mark trawl"));
  // A good interval says something of every observation that it meets.
  EXPECT_EQ(times_of(read_line(lines[4])).size(), 2U);
}

TEST(Commands, ANameIsKeptWithTheSchoolAndInItsRow) {
  const JournalState state = after({{3, DecideCommand{{renaming(key_a(), "north wall")}, ""}}});
  EXPECT_EQ(state.schools[0]->masks.decided.name, "north wall");
  EXPECT_EQ(state.schools[0]->masks.decided.status, "unreviewed") << "a name is no decision about what it is";
  EXPECT_EQ(school_title(*state.schools[0]), "school 1 (north wall)");
  EXPECT_EQ(school_title(*state.schools[1]), "school 2");
  const JournalLine written = line(1, 3, DecideCommand{{renaming(key_a(), "")}, ""});
  EXPECT_EQ(written.command, "rename");
  EXPECT_EQ((*written.args)["name"], "") << "an empty name takes the name away";
  EXPECT_EQ(after({{3, DecideCommand{{renaming(key_a(), "north wall")}, ""}},
                   {3, DecideCommand{{renaming(key_a(), "")}, ""}}})
                .schools[0]
                ->masks.decided.name,
            "");
}

std::vector<SchoolMasks> found_schools() { return masks_of(SmallSea::detected()); }

// A human's school has number 1 before anything is looked for: what is found later goes on from there, whatever of it the
// human's school had taken before.
TEST(Commands, WhatIsFoundLaterRenumbersNobody) {
  const SmallSea sea;
  BrushCommand apart;
  apart.runs = {{channel_at(0, 0), 5, 3}};
  GrowCommand on_a;
  on_a.seeds = {seed_a()};
  for (const Command& first : {Command(apart), Command(propagate_from(seed_a()))}) {
    std::vector<JournalLine> lines{line(1, 3, first), line(2, 0, DetectCommand{2}), line(3, 6, apart)};
    const JournalState alone = fold(std::span(lines).first(1), {}, sea.context());
    ASSERT_EQ(alone.schools.size(), 1U);
    ASSERT_EQ(alone.schools[0]->number, 1);
    const JournalState state = fold(lines, state_before_detection(found_schools()), sea.context());
    EXPECT_EQ(state.schools.front()->number, 1);
    EXPECT_EQ(state.schools.front()->made_by, 1);
    EXPECT_EQ(state.schools.back()->number, 4) << "1 by hand, 2 and 3 found";
    EXPECT_EQ(state.schools.back()->made_by, 3);
    // Of the two that were found the second is B, whether or not the first was taken over.
    const auto b = school_at(state, sea.context(), key_b());
    ASSERT_TRUE(b);
    EXPECT_EQ(state.schools[*b]->number, 3);
    // The journal alone knows their numbers while they are still looked for.
    const JournalState waiting = fold(lines, {}, sea.context());
    EXPECT_EQ(waiting.schools.back()->number, 4);
  }
}

TEST(Commands, OnlyClicksAndPropagationsFromThereLeaveASchoolThatGrowsAgain) {
  const SmallSea sea;
  GrowCommand grow;
  grow.seeds = {seed_a()};
  PropagateCommand on;
  on.school = key_a(3);
  const auto state_after = [&](const std::vector<std::pair<int, Command>>& acts) {
    std::vector<JournalLine> lines;
    for (const auto& [ping, command] : acts) {
      lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
    }
    return fold(lines, {}, sea.context());
  };
  const JournalState followed = state_after({{3, grow}, {3, on}});
  ASSERT_TRUE(followed.schools[0]->grown);
  EXPECT_EQ(followed.schools[0]->grown->ping_index, 3);
  EXPECT_EQ(followed.schools[0]->grown->followed.size(), 1U);
  EXPECT_TRUE(state_after({{3, grow}, {3, on}, {3, on}}).schools[0]->grown->followed.size() == 1U)
      << "what was done again counts once";
  PropagateCommand elsewhere = on;
  elsewhere.school = key_a(4);
  EXPECT_FALSE(state_after({{3, grow}, {3, on}, {4, elsewhere}}).schools[0]->grown);
  EXPECT_FALSE(
      state_after({{3, grow}, {3, on}, {4, EraseCommand{{{channel_at(2, 3), 31, 2}}, key_a(4)}}}).schools[0]->grown);
  EXPECT_TRUE(
      state_after({{3, grow}, {3, on}, {3, DecideCommand{{decision(key_a(3), "accepted")}, ""}}}).schools[0]->grown)
      << "a decision is about it, not of it";
}

TEST(Commands, SchoolIsFoundByTheVoxelThatNamesIt) {
  const SmallSea sea;
  const JournalState state = SmallSea::detected();
  for (std::size_t i = 0; i < state.schools.size(); ++i) {
    EXPECT_EQ(school_at(state, sea.context(), key_of(state.schools[i]->masks, sea.context())), i);
  }
}

}  // namespace
}  // namespace sonar
