// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

/// The sea, but in ping 6 school A is not to be seen.
CommandContext with_a_gap(const SmallSea& sea) {
  CommandContext context = sea.context();
  auto gap = std::make_shared<Volume>(*sea.volume);
  for (const Run& run : block_mask(kA).runs) {
    for (int s = run.first_sample; s < run.end(); ++s) {
      gap->counts.view().row(run.row)[static_cast<std::size_t>(s)] = static_cast<std::int16_t>(counts_from_db(-90.0));
    }
  }
  context.ping = [whole = context.ping, gap = std::shared_ptr<const Volume>(gap)](std::int64_t ping_index) {
    auto ping = whole(ping_index);
    if (ping_index == 6) ping->volume = gap;
    return ping;
  };
  return context;
}

/// The sea with one more voxel of A, which touches it at a corner alone: 73 voxels by 26 neighbours, 72 by 6.
CommandContext with_a_corner(const SmallSea& sea) {
  CommandContext context = sea.context();
  auto corner = std::make_shared<Volume>(*sea.volume);
  corner->counts(kA.last_fan + 1, kA.last_beam + 1, kA.last_sample + 1) =
      static_cast<std::int16_t>(counts_from_db(-40.0));
  context.ping = [whole = context.ping, corner = std::shared_ptr<const Volume>(corner)](std::int64_t ping_index) {
    auto ping = whole(ping_index);
    ping->volume = corner;
    return ping;
  };
  return context;
}

// Saved, loaded and replayed a click with 26 neighbours gives what it gave; a line of a journal that was written before
// the paper's propagation named its neighbours replays as it did, with 6.
TEST(Replay, KeepsTheNeighboursOfBothModes) {
  const SmallSea sea;
  for (const GrowMode mode : {GrowMode::tracked, GrowMode::paper}) {
    PropagateCommand command = propagate_from(seed_a());
    command.mode = command.grow.mode = mode;
    command.grow.connectivity = command.paper.connectivity = command.tracked.connectivity = Connectivity::all;
    command.paper.enlarge_fans = command.paper.enlarge_beams = 1;
    command.paper.enlarge_samples = 10;
    const auto voxels = [&](const JournalLine& said, std::size_t ping) {
      const auto masks = measured_masks_of(fold({&said, 1}, {}, with_a_corner(sea)), with_a_corner(sea).times);
      return masks.size() == 1 && masks[0].pings.size() == kPings ? masks[0].pings[ping].mask.voxels() : 0;
    };
    const auto act = act_of(line(1, 4, command));
    ASSERT_TRUE(act);
    for (const std::size_t ping : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
      EXPECT_EQ(voxels(line_of(*act), ping), 73U) << ping;
    }
    if (mode == GrowMode::tracked) continue;
    JournalLine old = line(1, 4, command);
    (*old.args)["propagate_paper"].erase("connectivity");
    EXPECT_EQ(voxels(old, 4), 73U);
    EXPECT_EQ(voxels(old, 5), 72U);
  }
}

/// Propagations from ping 4 both ways: in both modes, new and carried on, whole and with a reach.
std::vector<PropagateCommand> propagations() {
  PropagateCommand tracked = propagate_from(seed_a());
  PropagateCommand paper = tracked;
  paper.mode = GrowMode::paper;
  paper.paper = {1, 1, 10, Connectivity::faces};
  std::vector<PropagateCommand> all{tracked, paper};
  for (PropagateCommand on : {tracked, paper}) {
    on.seeds.clear();
    on.school = key_a(4);
    all.push_back(on);
    on.reach_backward = 2;
    all.push_back(on);
  }
  tracked.reach = 3;
  all.push_back(tracked);
  return all;
}

TEST(StoppedPropagation, StoppedPropagationComesBackAsTheCommandThatGivesItsState) {
  const SmallSea sea;
  const CommandContext context = with_a_gap(sea);
  const JournalState before = SmallSea::detected();
  for (const PropagateCommand& command : propagations()) {
    const JournalAct act{1, 0, "someone", ping_time(4), command};
    std::size_t steps_of_all = 0;
    CommandContext watched = context;
    watched.on_step = [&](std::int64_t, const PingMask&) { return ++steps_of_all > 0; };
    const auto whole = apply_watched(act, before, watched);
    ASSERT_TRUE(whole);
    EXPECT_EQ(told(whole->state), told(*apply(act, before, context)));
    EXPECT_EQ(line_of(whole->act).args, line_of(act).args);
    ASSERT_GE(steps_of_all, 3U);  // the paper ends at the gap
    for (std::size_t stop = 1; stop <= steps_of_all; ++stop) {
      std::vector<std::pair<std::int64_t, PingMask>> seen;
      watched.on_step = [&](std::int64_t ping_index, const PingMask& mask) {
        seen.emplace_back(ping_index, mask);
        return seen.size() < stop;
      };
      const auto stopped = apply_watched(act, before, watched);
      ASSERT_TRUE(stopped);
      ASSERT_EQ(seen.size(), stop);
      const auto read = act_of(line_of(stopped->act));  // as a journal brings it back
      ASSERT_TRUE(read);
      EXPECT_EQ(told(*apply(*read, before, context)), told(stopped->state)) << "stopped at ping " << seen.back().first;
      const std::size_t school = *school_at(stopped->state, context, key_a(4));
      for (const auto& [ping_index, mask] : seen) {
        const auto* there = in_ping(stopped->state.schools[school]->masks, ping_index);
        EXPECT_EQ(there == nullptr ? PingMask{} : there->mask, mask) << "ping " << ping_index;
      }
    }
  }
}

TEST(StoppedPropagation, PropagationStoppedOnTheWayBackNamesBothReaches) {
  const SmallSea sea;
  CommandContext context = sea.context();
  context.on_step = [](std::int64_t ping_index, const PingMask&) { return ping_index != 2; };
  const auto stopped = apply_watched({1, 0, "", ping_time(4), propagate_from(seed_a())}, SmallSea::detected(), context);
  ASSERT_TRUE(stopped);
  EXPECT_EQ(line_of(stopped->act).args->at("reach_backward"), 2);
  EXPECT_EQ(line_of(stopped->act).args->at("reach_forward"), 0);
  context.on_step = [](std::int64_t ping_index, const PingMask&) { return ping_index != 7; };
  const auto later = apply_watched({1, 0, "", ping_time(4), propagate_from(seed_a())}, SmallSea::detected(), context);
  ASSERT_TRUE(later);
  EXPECT_EQ(line_of(later->act).args->at("reach_backward"), -1);  // it came to its own end
  EXPECT_EQ(line_of(later->act).args->at("reach_forward"), 3);
}

TEST(StoppedPropagation, FoldIsWatchedByNobody) {
  const SmallSea sea;
  CommandContext context = sea.context();
  context.on_step = [](std::int64_t, const PingMask&) { return false; };
  const std::vector<JournalLine> lines{line(1, 4, propagate_from(seed_a()))};
  EXPECT_EQ(told(fold(lines, SmallSea::detected(), context)), told(fold(lines, SmallSea::detected(), sea.context())));
}

}  // namespace
}  // namespace sonar
