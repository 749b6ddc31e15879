// SPDX-License-Identifier: Apache-2.0
// Growing a school anew, and which schools keep their voxels when another grows over them.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"
#include "school/grow/mask_edit.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

const PingMask& mask_of(const JournalState& state, std::size_t school, std::int64_t ping) {
  return in_ping(state.schools[school]->masks, ping)->mask;
}

JournalState after(const std::vector<std::pair<int, Command>>& acts) {
  const SmallSea sea;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : acts) {
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
  }
  return fold(lines, SmallSea::detected(), sea.context());
}

TEST(WhoseVoxels, GrowingAnewLeavesWhatGrowsAndNothingElseOfThePing) {
  const RunKey stroke{channel_at(5, 6), 60, 4};  // water that nothing grows into
  GrowCommand anew;
  anew.to = GrowTo::replace;
  anew.school = key_a(3);
  anew.seeds = {seed_a()};
  anew.grow.tolerance_db = 7.0;
  const JournalState state = after({{3, BrushCommand{{stroke}, key_a(3)}}, {3, anew}});
  EXPECT_EQ(mask_of(state, 0, 3).runs, block_mask(kA).runs);
  EXPECT_NEAR(in_ping(state.schools[0]->masks, 3)->threshold_db, -47.0, 0.01);  // -40 dB less the tolerance
  EXPECT_EQ(in_ping(state.schools[0]->masks, 2)->threshold_db, -50.0);
  EXPECT_EQ(state.schools[0]->masks.decided.status, "corrected");
  // In a ping without the school there is nothing to take the place of.
  anew.school = key_a(4);
  const JournalState without = after({{3, EraseCommand{{{channel_at(2, 3), 30, 8}}, key_a(3)}},
                                      {3, SplitCommand{key_a(3), {}}},
                                      {2, DeleteCommand{key_a(3)}},
                                      {3, anew}});
  EXPECT_FALSE(without.notes.empty());
}

TEST(WhoseVoxels, WhatAHumanAcceptedKeepsItsVoxels) {
  // Weak water between A and B becomes fish: all three grow together.
  SmallSea sea;
  auto joined = std::make_shared<Volume>(*sea.volume);
  for (int s = kA.last_sample + 1; s < kB.first_sample; ++s) {
    joined->counts(2, 3, s) = static_cast<std::int16_t>(counts_from_db(-40.0));
  }
  sea.volume = joined;
  const auto done = [&](const std::vector<Command>& commands) {
    std::vector<JournalLine> lines;
    for (const Command& command : commands) {
      lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, 4, command));
    }
    return fold(effective_lines(lines), SmallSea::detected(), sea.context());
  };
  const DecideCommand accept{{Decision{key_b(), "accepted", {}, {}}}, ""};
  PropagateCommand on;
  on.school = key_a(4);
  GrowCommand more;
  more.to = GrowTo::add;
  more.school = key_a(4);
  more.seeds = {seed_a()};
  const std::vector<std::vector<Command>> grown{{more}, {more, on}, {propagate_from(seed_a())}};
  for (const std::vector<Command>& acts : grown) {
    std::vector<Command> after_accepting = acts;
    after_accepting.insert(after_accepting.begin(), accept);
    const JournalState kept = done(after_accepting);
    const auto b = school_at(kept, sea.context(), key_b(4));
    ASSERT_TRUE(b);
    EXPECT_EQ(kept.schools[*b]->number, 2);
    for (int ping = 0; ping < kPings; ++ping) EXPECT_EQ(mask_of(kept, *b, ping), block_mask(kB)) << ping;
    // Where nobody has looked at it, it is one with what grew over it, and an undo has both back.
    const JournalState merged = done(acts);
    const auto other = school_at(merged, sea.context(), key_b(4));
    ASSERT_TRUE(other);
    EXPECT_NE(merged.schools[*other]->number, 2);
    std::vector<JournalLine> lines;
    for (const Command& command : acts) lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, 4, command));
    for (auto n = static_cast<std::int64_t>(acts.size()); n > 0; --n) {
      lines.push_back(
          {static_cast<std::int64_t>(lines.size()) + 1, 0, "", "undo", 0, JsonValue(nlohmann::json{{"target", n}})});
    }
    EXPECT_EQ(told(fold(effective_lines(lines), SmallSea::detected(), sea.context())), told(SmallSea::detected()));
  }
}

}  // namespace
}  // namespace sonar
