// SPDX-License-Identifier: Apache-2.0
#include "session/marks/transects.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "pipeline/integrate/transects.h"
#include "session/app_parts.h"

namespace sonar {
namespace {

std::filesystem::path survey_of(const Workspace& workspace) {
  const auto& paths = workspace.document.paths();
  return paths.empty() ? std::filesystem::path{} : paths.front();
}

/// The first ping within a period, of the earliest observation with a grid that has one.
std::optional<SurveyPeriod> placed(const SurveyFiles& survey, const Transect& period) {
  std::optional<SurveyPeriod> earliest;
  TimeNs begins = 0;
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    if (!survey.observations[i].grid) continue;
    const auto& pings = survey.observations[i].navigation;
    const auto first = std::lower_bound(pings.begin(), pings.end(), period.start_utc,
                                        [](const PingNavigation& ping, TimeNs time) { return ping.time < time; });
    if (first == pings.end() || !period.holds(first->time) || (earliest && begins <= first->time)) continue;
    earliest = SurveyPeriod{period, i, first - pings.begin()};
    begins = first->time;
  }
  return earliest;
}

void remember_transects(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.listening.to(workspace.document.changes(), [&app, &workspace](DocumentChange change) {
    if (change != DocumentChange::survey) return;
    const std::filesystem::path file = file_of(app.preferences.transects, survey_of(workspace));
    if (file == workspace.transects().file) return;
    workspace.transects.set({});
    if (!file.empty()) open_transects(workspace, file);
  });
  app.listening.to(workspace.transects.changed(), [&app, &workspace] {
    const std::filesystem::path survey = survey_of(workspace);
    const std::filesystem::path& file = workspace.transects().file;
    if (survey.empty() || file.empty() || file_of(app.preferences.transects, survey) == file) return;
    set_file(app.preferences.transects, survey, file);
    keep_preferences(app);
  });
}

}  // namespace

std::vector<SurveyPeriod> survey_periods(const Workspace& workspace) {
  std::vector<SurveyPeriod> periods;
  if (workspace.document.survey() == nullptr) return periods;
  for (const Transect& period : workspace.transects().periods) {
    if (auto there = placed(*workspace.document.survey(), period)) periods.push_back(std::move(*there));
  }
  return periods;
}

void open_transects(Workspace& workspace, const std::filesystem::path& file) {
  auto periods = read_transects(file);
  if (!periods) return workspace.document.tell(to_line(periods.error()));
  const std::size_t count = periods->size();
  workspace.transects.set({file, std::move(*periods)});
  const std::size_t seen = survey_periods(workspace).size();
  workspace.document.tell(
      fmt::format("{}: {}, {} of them in this survey", file.filename().string(), count_of(count, "period"), seen));
}

void add_transects(AppModel& app) {
  Workspace& workspace = app.workspace;
  remember_transects(app);
  app.actions.add(
      {.id = "transects.open",
       .menu = "&File",
       .text = "Transects…",
       .keys = {},
       .tip = "A table of transects, strata and off-effort periods (CSV name,stratum,type,start_utc,stop_utc), "
              "shown on survey map and timelines and listed among the marks",
       .run =
           [&app, &workspace] {
             if (!app.dialogs.file_to_open) return;
             const std::string file = app.dialogs.file_to_open("Transects", "Tables (*.csv);;All files (*)");
             if (!file.empty()) open_transects(workspace, file);
           },
       .enabled = [&workspace] { return workspace.document.survey() != nullptr; }});
  app.actions.add({.id = "transects.none",
                   .menu = "&File",
                   .text = "No transects",
                   .keys = {},
                   .tip = "The table of transects is not shown any more",
                   .run =
                       [&app, &workspace] {
                         set_file(app.preferences.transects, survey_of(workspace), {});
                         keep_preferences(app);
                         workspace.transects.set({});
                       },
                   .enabled = [&workspace] { return !workspace.transects().periods.empty(); }});
}

}  // namespace sonar
