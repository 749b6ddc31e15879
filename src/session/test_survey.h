// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "session/open/document.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {

/// A small simulated survey on disk, made once a test program and taken away at its end; for tests.
class TestSurvey {
 public:
  [[nodiscard]] static const TestSurvey& easy() {
    static const TestSurvey survey;
    return survey;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return raw_; }
  /// A fresh folder for journals and results.
  [[nodiscard]] std::filesystem::path fresh() const {
    static int count = 0;
    auto path = root_ / ("work-" + std::to_string(++count));
    std::filesystem::create_directories(path);
    return path;
  }
  /// Options whose journal lies in a folder, made by nobody at one time.
  [[nodiscard]] static DocumentOptions options(const std::filesystem::path& journal) {
    DocumentOptions options;
    options.operator_name = "tester";
    options.program_version = "test";
    options.journal_folders = [journal](const auto&) { return std::vector{journal}; };
    options.clock = [] { return TimeNs{1'790'000'000} * kSecondNs; };
    options.prefetch = 2;
    return options;
  }
  /// Two observations of so many pings each; in each two schools, clean and bright.
  static constexpr std::int64_t kPings = 12;

 private:
  TestSurvey() {
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 2;
    params.pings = static_cast<int>(kPings);
    params.schools = 2;
    Work work;
    (void)synth::simulate_survey(raw_, params, synth::ms70_beams(), false, "test", work);
  }
  ~TestSurvey() {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }

  std::filesystem::path root_ =
      std::filesystem::temp_directory_path() /
      ("sonar-session-test-" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
  std::filesystem::path raw_ = root_ / "raw";

 public:
  TestSurvey(const TestSurvey&) = delete;
  TestSurvey& operator=(const TestSurvey&) = delete;
};

}  // namespace sonar
