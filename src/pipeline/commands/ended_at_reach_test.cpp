// SPDX-License-Identifier: Apache-2.0
// Where a propagation by hand ended only because it was asked no farther.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

using Acts = std::vector<std::pair<int, Command>>;

/// Where nothing was detected.
JournalState after(const Acts& acts) {
  static const SmallSea kSea;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : acts) {
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
  }
  return fold(lines, {}, kSea.context());
}

PropagateCommand reaching(std::int64_t pings) {
  PropagateCommand command = propagate_from(seed_a());
  command.reach = pings;
  return command;
}

std::string ends(const JournalState& state, std::int64_t number) {
  for (const auto& school : state.schools) {
    if (school->number == number) return ended_at_reach(school->masks);
  }
  return "no such school";
}

TEST(EndedAtReach, IsMarkedWhereTheReachAloneEndedIt) {
  const auto of = [](int ping, const PropagateCommand& command) { return ends(after({{ping, command}}), 1); };
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
  EXPECT_EQ(ends(after({{4, reaching(2)}, {6, on}}), 1), "first");
  // Cut off by hand, it is the human's end.
  EraseCommand erase;
  for (int row = 0; row < kFans * kBeams; ++row) erase.runs.push_back({row, 5, kSamples - 5});
  EXPECT_EQ(ends(after({{4, reaching(2)}, {6, erase}}), 1), "first");
  // Split, each part has the end that is its.
  const JournalState split = after({{4, reaching(2)}, {4, SplitCommand{key_a(4), {}}}});
  EXPECT_EQ(ends(split, 1), "first");
  EXPECT_EQ(ends(split, 2), "last");
  // And merged the farther ones.
  const Acts merged{{4, reaching(2)}, {4, SplitCommand{key_a(4), {}}}, {3, MergeCommand{{key_a(3), key_a(4)}}}};
  EXPECT_EQ(ends(after(merged), 1), "both");
  // What goes through the tables is what the state says.
  EXPECT_EQ(masks_of(after({{4, reaching(2)}}))[0].decided.ended_at_reach, "both");
}

TEST(EndedAtReach, StoppedByAHumanItEndsAtWhatWasReached) {
  const SmallSea sea;
  CommandContext context = sea.context();
  context.on_step = [](std::int64_t ping, const PingMask&) { return ping != 6; };
  const JournalAct act{1, kBegin, "someone", ping_time(4), reaching(-1)};
  const auto watched = apply_watched(act, {}, context);
  ASSERT_TRUE(watched);
  EXPECT_EQ(ends(watched->state, 1), "last");
  const auto again = apply(watched->act, {}, sea.context());
  ASSERT_TRUE(again);
  EXPECT_EQ(ends(*again, 1), "last");
}

}  // namespace
}  // namespace sonar
