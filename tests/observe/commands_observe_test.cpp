// SPDX-License-Identifier: Apache-2.0
// Human choices on top of detected schools: a state that was folded step by step, and a run on the journal's file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/observe.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {
namespace {

class CommandsObserved : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("sonar-commands-" + std::to_string(::getpid()));
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 1;
    params.pings = 16;
    params.schools = 2;
    Work work;
    ASSERT_TRUE(synth::simulate_survey(folder_, params, synth::ms70_beams(), false, "test", work));
    const std::vector<std::filesystem::path> paths{folder_};
    auto survey = open_survey(paths, {}, {}, {}, work);
    ASSERT_TRUE(survey);
    survey_ = std::make_unique<SurveyFiles>(std::move(*survey));
    product_ = std::make_unique<ObservationProduct>(observed({}));
    ASSERT_EQ(product_->schools.size(), 2U);
  }
  static void TearDownTestSuite() {
    survey_.reset();
    product_.reset();
    std::filesystem::remove_all(folder_);
  }

  static const ObservationFiles& observation() { return survey_->observations.front(); }
  static ObservationProduct observed(const std::vector<JournalLine>& journal) {
    Work work(2);
    auto product = observe(*survey_, observation(), {}, {{}, journal, "test"}, work);
    EXPECT_TRUE(product);
    return product ? *product : ObservationProduct{};
  }

  /// The detected schools of the product: where the journal begins.
  static JournalState detected() {
    std::vector<SchoolMasks> schools;
    for (const SchoolRow& row : product_->schools) {
      SchoolMasks school;
      for (const SchoolMask& mask : product_->masks) {
        if (mask.school_id == row.school_id) school.pings.push_back({mask.ping_index, mask.mask, kUnknown});
      }
      schools.push_back(std::move(school));
    }
    return state_of_detected(std::move(schools));
  }

  static inline std::filesystem::path folder_;
  static inline std::unique_ptr<SurveyFiles> survey_;
  static inline std::unique_ptr<ObservationProduct> product_;
};

/// A longest run of a school in one of its pings.
sonar::Run longest_run(const SchoolMasks::InPing& there) {
  return *std::max_element(there.mask.runs.begin(), there.mask.runs.end(),
                           [](const auto& a, const auto& b) { return a.count < b.count; });
}

/// A session: every kind of act, each upon what the acts before it left.
std::vector<JournalLine> session(const CommandContext& context, JournalState& state) {
  std::vector<JournalLine> lines;
  const auto act = [&](std::int64_t ping, Command command) {
    const JournalAct made{static_cast<std::int64_t>(lines.size()) + 1, 1'600'000'000 * kSecondNs, "someone",
                          context.times[static_cast<std::size_t>(ping)], std::move(command)};
    auto next = apply(made, state, context);
    EXPECT_TRUE(next) << command_name(made.command) << ": " << (next ? "" : next.error().text);
    if (next) state = *next;
    lines.push_back(line_of(made));
  };
  const auto school = [&](std::size_t i) { return state.schools.at(i)->masks; };
  const SchoolMasks first = school(0);
  const SchoolMasks::InPing middle = first.pings[first.pings.size() / 2];
  const sonar::Run run = longest_run(middle);
  const int channel = context.grid->channel[static_cast<std::size_t>(run.row)];
  act(middle.ping_index, DecideCommand{{{key_of(first, context), "accepted", "herring", {}}}, ""});
  act(middle.ping_index, BrushCommand{{{channel, run.first_sample, run.count + 30}}, key_of(first, context)});
  act(middle.ping_index, ReshapeCommand{Reshaping::smooth, key_of(school(0), context), true});
  PropagateCommand click;
  const SchoolMasks second = school(1);
  const SchoolMasks::InPing& there = second.pings[second.pings.size() / 2];
  const sonar::Run seed = longest_run(there);
  click.seeds = {{context.grid->channel[static_cast<std::size_t>(seed.row)], seed.first_sample + seed.count / 2}};
  act(there.ping_index, click);
  const SchoolMasks carried = state.schools.back()->masks;
  act(carried.pings[carried.pings.size() / 2].ping_index, SplitCommand{key_of(carried, context), {}});
  act(0, BadPingsCommand{context.times[2], context.times[4]});
  return lines;
}

TEST_F(CommandsObserved, RunOnTheJournalGivesTheSameMasksAsTheState) {
  Work work(1);
  Engine engine(*survey_, observation(), {});
  ASSERT_TRUE(engine.estimate_background(0, engine.pings() - 1, work));
  const CommandContext context = context_of(engine, {0, engine.pings() - 1});
  JournalState state = detected();
  const std::vector<JournalLine> lines = session(context, state);

  // Through a file, as a run gets them.
  const std::string path = (folder_ / "session.jsonl").string();
  for (const JournalLine& line : lines) ASSERT_TRUE(append_journal(path, {}, line));
  const auto journal = read_journal(path);
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->lines.size(), lines.size());
  const ObservationProduct product = observed(effective_lines(journal->lines));

  const auto schools = numbered(measured_masks_of(state, context.times), *observation().grid);
  ASSERT_EQ(product.schools.size(), schools.size());
  std::size_t row = 0;
  for (const SchoolMasks& school : schools) {
    const SchoolRow& written = product.schools[static_cast<std::size_t>(school.decided.school_id - 1)];
    EXPECT_EQ(written.status, school.decided.status);
    EXPECT_EQ(written.origin, school.decided.origin);
    EXPECT_EQ(written.species, school.decided.species);
    EXPECT_EQ(written.operator_name, school.decided.operator_name);
    EXPECT_EQ(written.decided_utc, school.decided.decided_utc);
    for (const SchoolMasks::InPing& in_ping : school.pings) {
      ASSERT_LT(row, product.masks.size());
      EXPECT_EQ(product.masks[row].school_id, school.decided.school_id);
      EXPECT_EQ(product.masks[row].ping_index, in_ping.ping_index);
      EXPECT_EQ(product.masks[row].mask, in_ping.mask) << "school " << school.decided.school_id;
      EXPECT_TRUE(in_ping.ping_index < 2 || in_ping.ping_index > 4);
      ++row;
    }
  }
  EXPECT_EQ(row, product.masks.size());
  for (std::size_t i = 0; i < product.pings.size(); ++i) EXPECT_EQ(product.pings[i].bad, i >= 2 && i <= 4);
  EXPECT_EQ(product.schools[0].species, "herring");
  EXPECT_EQ(product.schools[0].status, "corrected");
}

TEST_F(CommandsObserved, KeyChangesWithEveryLineThatConcernsTheObservation) {
  const auto key = [&](std::vector<JournalLine> journal) {
    return observation_key(*survey_, observation(), {}, {{}, journal, "test"});
  };
  const TimeNs first = survey_->ping_time(observation(), 0);
  const std::string before = key({});
  const auto line = [](TimeNs time, Command command) {
    return line_of({1, 5 * kSecondNs, "", time, std::move(command)});
  };
  // An interval and a bulk decision may be said on a ping of another observation.
  EXPECT_NE(key({line(0, BadPingsCommand{first - kSecondNs, first + kSecondNs})}), before);
  EXPECT_NE(key({line(0, DecideCommand{{{{first, 3, 4}, "accepted", {}, {}}}, "rule"})}), before);
  EXPECT_EQ(key({line(0, BadPingsCommand{first - 2 * kSecondNs, first - kSecondNs})}), before);
  EXPECT_EQ(key({line(0, DeleteCommand{{0, 3, 4}})}), before);
  JournalLine later = line(first, DecideCommand{{{{first, 3, 4}, "accepted", {}, {}}}, ""});
  const std::string decided = key({later});
  later.decided += kSecondNs;  // it is written into a column
  EXPECT_NE(key({later}), decided);
}

}  // namespace
}  // namespace sonar
