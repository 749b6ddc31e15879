// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/index_cache.h"
#include "pipeline/journal/journal.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {

/// What a run is made of: a survey and how it is to be worked on, or a plan, which says both.
struct RunSources {
  std::vector<std::filesystem::path> survey;  ///< folders of raw files, or raw files
  std::string session;                        ///< journal, or the folder of several people's; empty = none
  std::function<Result<Recipe>(const Journal&)> recipe;
  std::filesystem::path plan;  ///< instead of those; empty = none
  IndexCache cache = IndexCache::of_user();
};

/// A survey with what is to be done to it.
struct Opened {
  Plan plan;
  SurveyFiles survey;
  ReadJournal journal;
};

/// The survey that is to be run, indexed.
/// errors  as open_survey(), require_files(), read_session(), read_plan(); those of the recipe
[[nodiscard]] Result<Opened> open_for_run(const RunSources& sources, Work& work);
/// Makes the plan and writes it to OUT/plan.json; products that it calls for anew are set aside.
[[nodiscard]] Result<void> write_plan(Opened& opened, const RunSources& sources, const RunOptions& options);
/// What a newer program planned here is not ours to replace.
/// errors  newer_version
[[nodiscard]] Result<void> require_no_newer_plan(const std::filesystem::path& out);
/// Files that gave nothing, each with the reason.
[[nodiscard]] std::vector<RunFailure> failed_files(const SurveyFiles& survey);

}  // namespace sonar
