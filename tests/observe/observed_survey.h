// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/journal/manual.h"
#include "pipeline/stages/observe.h"
#include "pipeline/survey/survey.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar::test {

/// One small survey for all tests of a suite: 24 pings, two schools, easy water.
class ObservedSurvey : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("sonar-observe-" + std::to_string(::getpid()));
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 1;
    params.pings = 24;
    params.schools = 2;
    Work work;
    ASSERT_TRUE(synth::simulate_survey(folder_, params, synth::ms70_beams(), false, "test", work));
    const std::vector<std::filesystem::path> paths{folder_};
    auto survey = open_survey(paths, {}, {}, {}, work);
    ASSERT_TRUE(survey);
    survey_ = std::make_unique<SurveyFiles>(std::move(*survey));
    auto product = observe(*survey_, observation(), {}, {{}, {}, "test"}, work);
    ASSERT_TRUE(product);
    product_ = std::make_unique<ObservationProduct>(std::move(*product));
  }
  static void TearDownTestSuite() {
    survey_.reset();
    product_.reset();
    std::filesystem::remove_all(folder_);
  }

  static const ObservationFiles& observation() { return survey_->observations.front(); }

  /// A click on the middle of a school that was found.
  static JournalLine click(GrowMode mode) {
    const SchoolMask& found = product_->masks[product_->masks.size() / 2];
    const auto longest = std::max_element(found.mask.runs.begin(), found.mask.runs.end(),
                                          [](const auto& a, const auto& b) { return a.count < b.count; });
    PropagateCommand command;
    command.mode = mode;
    command.grow.mode = mode;
    command.grow.tolerance_opacity = 0.25;
    const int channel = observation().grid->channel[static_cast<std::size_t>(longest->row)];
    command.seeds = {{channel, longest->first_sample + longest->count / 2}};
    JournalLine line;
    line.n = 1;
    line.decided = 1'600'000'000 * kSecondNs;
    line.operator_name = "someone";
    line.command = "propagate";
    line.ping_time = survey_->ping_time(observation(), static_cast<std::size_t>(found.ping_index));
    *line.args = to_json(command);
    return line;
  }

  static ObservationProduct observed(const Recipe& recipe, std::vector<JournalLine> journal) {
    Work work(2);
    auto product = observe(*survey_, observation(), recipe, {{}, journal, "test"}, work);
    EXPECT_TRUE(product);
    return product ? *product : ObservationProduct{};
  }

  static int count(const ObservationProduct& product, DiagnosticCode code) {
    return static_cast<int>(std::count_if(product.diagnostics.begin(), product.diagnostics.end(),
                                          [&](const Diagnostic& note) { return note.code == code; }));
  }

  static inline std::filesystem::path folder_;
  static inline std::unique_ptr<SurveyFiles> survey_;
  static inline std::unique_ptr<ObservationProduct> product_;
};

}  // namespace sonar::test
