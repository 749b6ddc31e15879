// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/open_for_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "io/atomic_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/manual.h"

namespace sonar {
namespace {

/// Journal lines whose ping is in no observation: listed, never moved.
void note_lost_choices(Opened& opened) {
  for (const ReadLine& read : opened.journal.lines()) {
    const JournalLine& line = read.line;
    const bool found = std::any_of(opened.survey.observations.begin(), opened.survey.observations.end(),
                                   [&](const ObservationFiles& observation) {
                                     return ping_at(opened.survey, observation, line.ping_time).has_value();
                                   });
    if (found) continue;
    opened.survey.diagnostics.push_back({DiagnosticCode::decision_lost, opened.plan.session, -1, -1,
                                         fmt::format("choice {} ({}): the survey has no ping of {}", line_title(line.n),
                                                     line.command, iso_time(line.ping_time))});
  }
}

/// Why a file gave nothing; empty where it did.
std::string why_nothing_came_of(const RawIndex& index) {
  if (index.gives_samples()) {
    const bool unusable = index.pings.empty() && index.datagrams.count("RAW0") > 0;
    return unusable ? "none of its samples could be used; sonarx info tells why" : "";
  }
  for (const Diagnostic& note : index.diagnostics) {
    if (note.code == DiagnosticCode::not_recognised || note.code == DiagnosticCode::format_not_read) return note.text;
  }
  return fmt::format("format {} is not read by this version", name(index.format));
}

}  // namespace

Result<Opened> open_for_run(const RunSources& sources, Work& work) {
  Opened opened;
  std::vector<std::filesystem::path> paths = sources.survey;
  opened.plan.session = sources.session;
  if (!sources.plan.empty()) {
    auto plan = read_plan(sources.plan);
    if (!plan) return pass_on(plan);
    opened.plan = std::move(*plan);
    paths.assign(opened.plan.survey.begin(), opened.plan.survey.end());
  }
  auto journal = opened.plan.session.empty() ? Result<Journal>(Journal{}) : read_session(opened.plan.session);
  if (!journal) return pass_on(journal);
  if (sources.plan.empty()) {
    auto recipe = sources.recipe(*journal);
    if (!recipe) return pass_on(recipe);
    opened.plan.recipe = std::move(*recipe);
  }
  const Recipe& recipe = opened.plan.recipe;
  auto survey = open_survey(paths, recipe.survey, recipe.navigation, sources.cache, work);
  if (!survey) return pass_on(survey);
  if (auto some = require_files(*survey, paths); !some) return pass_on(some);
  opened.survey = std::move(*survey);
  opened.survey.diagnostics.insert(opened.survey.diagnostics.end(), journal->diagnostics.begin(),
                                   journal->diagnostics.end());
  opened.journal = effective_lines(journal->lines);
  note_lost_choices(opened);
  return opened;
}

Result<void> write_plan(Opened& opened, const RunSources& sources, const RunOptions& options) {
  if (auto ours = require_no_newer_plan(options.out); !ours) return ours;
  opened.plan = make_plan(opened.survey, sources.survey, sources.session, opened.plan.recipe,
                          {options.pings, opened.journal, options.program_version});
  if (auto possible = require_possible(opened.plan, options); !possible) return possible;
  if (auto held = set_aside(options.out, opened.plan); !held) return held;
  return write_file(options.out / "plan.json", plan_text(opened.plan));
}

std::vector<RunFailure> failed_files(const SurveyFiles& survey) {
  std::vector<RunFailure> failures;
  for (const SurveyFile& file : survey.files) {
    const std::string why = why_nothing_came_of(file.index);
    if (file.error) {
      failures.push_back({std::nullopt, *file.error});
    } else if (!why.empty()) {
      failures.push_back({std::nullopt, {ErrorCode::format, why, {file.path.string(), 0}}});
    }
  }
  return failures;
}

Result<void> require_no_newer_plan(const std::filesystem::path& out) {
  std::error_code absent;
  if (!std::filesystem::exists(out / "plan.json", absent)) return {};
  const auto plan = read_plan(out / "plan.json");
  if (!plan && plan.error().code == ErrorCode::newer_version) return pass_on(plan);
  return {};
}

}  // namespace sonar
