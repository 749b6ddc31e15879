// SPDX-License-Identifier: Apache-2.0
#include "session/review/beyond_reach.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "pipeline/journal/continued.h"
#include "session/open/survey_schools.h"
#include "session/tools/growth.h"

namespace sonar {
namespace {

std::string open_ends(const Workspace& workspace, const SurveySchool& school) {
  return open_ends(workspace.document.state(school.name.observation), *school.state);
}

/// The selected school, where it lies in the observation on show and may be carried on.
std::optional<SurveySchool> open_school(const Workspace& workspace) {
  auto school = selected_school(workspace);
  const auto& shown = workspace.document.shown();
  if (!school || !shown || shown->index() != school->name.observation) return std::nullopt;
  if (workspace.document.busy() || open_ends(workspace, *school).empty()) return std::nullopt;
  return school;
}

/// From one end, that way alone.
void carry_on_from(Workspace& workspace, const SurveySchool& school, bool forwards,
                   const std::shared_ptr<JournalStep>& step) {
  const auto& pings = school.state->masks.pings;
  SchoolMasks end;
  end.pings = {forwards ? pings.back() : pings.front()};
  PropagateCommand command = propagation_as_set(workspace);
  command.school = key_of(end, school.observation->context());
  (forwards ? command.reach_backward : command.reach_forward) = 0;
  workspace.document.act(school.name.observation, end.pings.front().ping_index, std::move(command), step);
}

}  // namespace

void continue_beyond_reach(Workspace& workspace) {
  const auto school = open_school(workspace);
  if (!school) return;
  const std::string ends = open_ends(workspace, *school);
  const auto step = std::make_shared<JournalStep>();
  if (ends_first(ends)) carry_on_from(workspace, *school, false, step);
  if (ends_last(ends)) carry_on_from(workspace, *school, true, step);
}

void add_continuing(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.actions.add({.id = std::string(kContinueAction),
                   .menu = "&Schools",
                   .text = "Continue beyond the reach",
                   .keys = {"Ctrl+Shift+P"},
                   .tip = "Follow the selected school on from where its propagation had its reach, as far again",
                   .run = [&workspace] { continue_beyond_reach(workspace); },
                   .enabled = [&workspace] { return open_school(workspace).has_value(); },
                   .of_school = true});
}

}  // namespace sonar
