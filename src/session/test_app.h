// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "base/check.h"
#include "session/app_parts.h"
#include "session/open/survey_schools.h"
#include "session/test_survey.h"

namespace sonar {

/// An app on the small simulated survey, for tests: acts are asked for by their ids, as keys and menus do.
class TestApp {
 protected:
  /// Opens the survey, or begins a new run on the same journal.
  void begin() {
    app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
    document().open({TestSurvey::easy().folder()});
    document().settle();
  }
  [[nodiscard]] Document& document() { return app_->workspace.document; }
  [[nodiscard]] Workspace& workspace() { return app_->workspace; }
  /// Masks of the school that detection finds in most pings of the first observation.
  [[nodiscard]] SchoolMasks longest_found() {
    document().detect({0});
    document().settle();
    const auto& schools = document().state(0).schools;
    const auto longest = std::max_element(schools.begin(), schools.end(), [](const auto& a, const auto& b) {
      return a->masks.pings.size() < b->masks.pings.size();
    });
    return longest == schools.end() ? SchoolMasks{} : (*longest)->masks;
  }
  /// What a key or a menu does.
  void press(const std::string& id) {
    const Action* action = app_->actions.find(id);
    SONAR_CHECK(action != nullptr);
    if (!action->enabled || action->enabled()) action->run();
  }
  /// A brush stroke: a new school of some beams, fans and samples in each of some pings.
  void paint(std::int64_t first_ping, std::int64_t last_ping, int first_fan, int first_beam, int sample, int size = 3,
             int samples = 6) {
    std::optional<SchoolKey> school;
    for (std::int64_t ping = first_ping; ping <= last_ping; ++ping) {
      BrushCommand command;
      for (int fan = first_fan; fan < first_fan + size; ++fan) {
        for (int beam = first_beam; beam < first_beam + size; ++beam) {
          command.runs.push_back({channel(fan, beam), sample, samples});
        }
      }
      command.school = school;
      document().act(ping, std::move(command));
      const TimeNs time = document().survey()->ping_time(document().shown()->files(), static_cast<std::size_t>(ping));
      school = SchoolKey{time, channel(first_fan, first_beam), sample};
    }
  }
  [[nodiscard]] int channel(int fan, int beam) {
    const BeamGrid& grid = document().shown()->grid();
    return grid.channel[static_cast<std::size_t>(fan * grid.beams() + beam)];
  }
  void select(std::int64_t number) { workspace().school.set(SchoolName{document().shown()->index(), number}); }
  [[nodiscard]] const JournalLine& last_line() { return document().choices().lines->back(); }

  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  std::unique_ptr<AppModel> app_;
};

}  // namespace sonar
