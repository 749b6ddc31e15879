// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_context.h"

// Commands upon the small sea, for tests.
namespace sonar::test {

inline Decision decision(const SchoolKey& school, std::optional<std::string> status,
                         std::optional<std::string> species = {}, std::optional<std::string> comment = {}) {
  return {school, std::move(status), std::move(species), std::move(comment)};
}

inline Decision renaming(const SchoolKey& school, std::string name) {
  Decision made;
  made.school = school;
  made.name = std::move(name);
  return made;
}

/// One of every command, each of which can be carried out upon detected().
inline std::vector<std::pair<int, Command>> every_command() {
  GrowCommand grow;
  grow.seeds = {seed_a()};
  GrowCommand more = grow;
  more.to = GrowTo::add;
  more.school = key_b(3);
  GrowCommand less = grow;
  less.to = GrowTo::take_away;
  less.school = key_a(3);
  GrowCommand anew = grow;
  anew.to = GrowTo::replace;
  anew.school = key_a(3);
  PropagateCommand on;
  on.school = key_b(4);
  on.reach_backward = 0;
  const RunKey stroke{channel_at(2, 3), 38, 3};
  return {{4, propagate_from(seed_a())},
          {4, on},
          {3, grow},
          {3, more},
          {3, less},
          {3, anew},
          {3, BrushCommand{{stroke}, key_a(3)}},
          {3, BrushCommand{{stroke}, {}}},
          {3, EraseCommand{{{channel_at(2, 3), 31, 2}}, key_a(3)}},
          {3, EraseCommand{{{channel_at(2, 3), 31, 20}}, {}}},
          {3, ReshapeCommand{Reshaping::fill_holes, key_a(3), false}},
          {3, ReshapeCommand{Reshaping::smooth, key_a(3), true}},
          {3, ReshapeCommand{Reshaping::largest_part, key_b(3), true}},
          {3, MergeCommand{{key_a(), key_b()}}},
          {3, SplitCommand{key_a(), {}}},
          {3, HandOverCommand{key_a(), key_b(), ping_time(2), ping_time(4)}},
          {3, HandOverCommand{key_a(), {}, ping_time(7), ping_time(8)}},
          {3, DeleteCommand{key_b()}},
          {3, DecideCommand{{decision(key_a(), "accepted")}, ""}},
          {3, DecideCommand{{decision(key_a(), {}, "herring")}, ""}},
          {3, DecideCommand{{decision(key_a(), {}, {}, "near the \"wreck\"")}, ""}},
          {3, DecideCommand{{renaming(key_a(), "north wall")}, ""}},
          {3, DecideCommand{{decision(key_a(), "accepted"), decision(key_b(), "rejected")}, "5 pings or more"}},
          {3, EventCommand{"trawl", ping_time(2), "haul 12"}},
          {3, EventCommand{"bookmark", ping_time(3), "", R"({"fan":3})"}},
          {3, BadPingsCommand{ping_time(3), ping_time(3)}},
          {3, BadPingsCommand{ping_time(5), ping_time(6)}}};
}

inline JournalState after(const std::vector<std::pair<int, Command>>& acts) {
  const SmallSea sea;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : acts)
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
  return fold(lines, SmallSea::detected(), sea.context());
}

}  // namespace sonar::test
