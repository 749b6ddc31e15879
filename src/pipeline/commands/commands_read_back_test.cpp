// SPDX-License-Identifier: Apache-2.0
// Commands as lines of a journal: written, read back, folded, and refused where they cannot be carried out.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/commands/test_commands.h"
#include "pipeline/commands/test_context.h"

namespace sonar {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

TEST(CommandsReadBack, EveryCommandIsReadBackAsItWasWritten) {
  for (const auto& [ping, command] : every_command()) {
    const JournalLine written = line(1, ping, command);
    const auto read = act_of(written);
    ASSERT_TRUE(read) << written.command << ": " << read.error().text;
    const JournalLine again = line_of(*read);
    EXPECT_EQ(again.command, written.command);
    EXPECT_EQ(again.args, written.args) << written.command;
    EXPECT_EQ(read->command.index(), command.index());
  }
}

TEST(CommandsReadBack, FoldOfAPrefixAndTheRestIsTheFoldOfAll) {
  const SmallSea sea;
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : every_command()) {
    lines.push_back(line(static_cast<std::int64_t>(lines.size()) + 1, ping, command));
  }
  const std::string all = told(fold(lines, SmallSea::detected(), sea.context()));
  for (std::size_t cut = 0; cut <= lines.size(); ++cut) {
    const std::span<const JournalLine> every(lines);
    const JournalState first = fold(every.first(cut), SmallSea::detected(), sea.context());
    ASSERT_EQ(told(fold(every.subspan(cut), first, sea.context())), all) << "cut at " << cut;
  }
}

TEST(CommandsReadBack, ACalibrationIsReadBackChangesNoSchoolAndIsUndone) {
  const SmallSea sea;
  CalibrateCommand calibrate;
  calibrate.calibration.water.salinity_psu = 7.0;
  calibrate.calibration.absorption = AbsorptionSource::ainslie_mccolm;
  calibrate.calibration.beams = {{3, 27.5, kUnknown, 0.5}};
  calibrate.file = "sphere.csv";
  JournalLine act = line(1, 3, calibrate);
  const auto read = act_of(act);
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(line_of(*read).args->dump(), act.args->dump());  // as text: an unknown value equals nothing
  // Wherever it was said, it is about the whole survey.
  act.ping_time += 1000 * kSecondNs;
  const JournalState done = fold({&act, 1}, SmallSea::detected(), sea.context());
  EXPECT_EQ(told(done), told(SmallSea::detected()));
  ASSERT_TRUE(done.calibration);
  const Recipe recipe = measuring_recipe({}, done);
  EXPECT_EQ(recipe.calibration.water.salinity_psu, 7.0);
  ASSERT_EQ(recipe.calibration.beams.size(), 1U);
  EXPECT_TRUE(std::isnan(recipe.calibration.beams[0].sa_correction_db));
  EXPECT_EQ(recipe_text(measuring_recipe({}, SmallSea::detected())), recipe_text({}));
  const JournalLine undo{2, 0, "", "undo", 0, JsonValue(nlohmann::json{{"target", 1}})};
  EXPECT_FALSE(fold(effective_lines({act, undo}), SmallSea::detected(), sea.context()).calibration);
}

TEST(CommandsReadBack, ALineThatAsksForDetectionSaysHowManyWereFound) {
  const JournalLine written = line(1, 0, DetectCommand{7});
  EXPECT_EQ((*written.args)["schools"], 7);
  const auto read = act_of(written);
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<DetectCommand>(read->command).schools, 7);
  JournalLine older = written;
  *older.args = nlohmann::json::object();
  ASSERT_TRUE(act_of(older));
  for (const auto& wrong : {nlohmann::json(-1), nlohmann::json("two"), nlohmann::json(1e15)}) {
    *older.args = {{"schools", wrong}};
    EXPECT_FALSE(act_of(older)) << wrong.dump();
  }
}

TEST(CommandsReadBack, LinesOfOtherPingsChangeNothing) {
  std::vector<JournalLine> lines;
  for (const auto& [ping, command] : every_command()) {
    if (std::holds_alternative<DecideCommand>(command) || std::holds_alternative<EventCommand>(command) ||
        std::holds_alternative<BadPingsCommand>(command)) {
      continue;
    }
    JournalLine other = line(1, ping, command);
    other.ping_time += kSecondNs;
    lines.push_back(other);
  }
  EXPECT_EQ(told(fold(lines, SmallSea::detected(), SmallSea{}.context())), told(SmallSea::detected()));
}

TEST(CommandsReadBack, WhatCannotBeDoneIsADiagnosticAndChangesNothing) {
  GrowCommand ringing;
  ringing.seeds = {{channel_at(2, 3), 2}};
  GrowCommand nowhere;
  nowhere.seeds = {{700, 33}};
  PropagateCommand off;
  off.school = key_a(3);
  const std::vector<std::pair<int, Command>> acts{{3, ringing},
                                                  {3, nowhere},
                                                  {3, BrushCommand{{{channel_at(2, 3), 78, 3}}, {}}},
                                                  {3, BrushCommand{{{channel_at(2, 3), 0, 3}}, {}}},
                                                  {3, BrushCommand{{{99, 30, 3}}, key_a()}},
                                                  {3, MergeCommand{{key_a(), key_a(2)}}},
                                                  {0, SplitCommand{key_a(), {}}},
                                                  {3, SplitCommand{key_a(), seed_a()}},
                                                  {3, SplitCommand{key_a(), SeedKey{100000, 3}}},
                                                  {3, HandOverCommand{key_a(), key_a(2), ping_time(2), ping_time(3)}},
                                                  {3, HandOverCommand{key_a(), key_b(), ping_time(9), ping_time(10)}},
                                                  {3, HandOverCommand{key_a(), {}, ping_time(0), ping_time(8)}},
                                                  {3, EraseCommand{{{channel_at(0, 0), 0, 2'000'000'000}}, {}}}};
  JournalState state = after(acts);
  EXPECT_EQ(state.notes.size(), acts.size());
  for (const Diagnostic& note : state.notes) EXPECT_EQ(note.code, DiagnosticCode::decision_lost);
  state.notes.clear();
  EXPECT_EQ(told(state), told(SmallSea::detected()));
}

}  // namespace
}  // namespace sonar
