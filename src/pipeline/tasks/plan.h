// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/observe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

inline constexpr int kPlanVersion = 1;

/// One observation to be worked on; its number is its place in the plan, from 0.
struct PlanTask {
  std::string observation;
  std::vector<std::string> files;  ///< names without folder
  std::int64_t pings = 0;
  TimeNs first_time = 0;
  TimeNs last_time = 0;
  bool continues_cut = false;  ///< begun only because the one before reached observation_max_s
  std::string key;             ///< observation_key(): the product that is right has this input_hash
};

/// The same work cut into independent tasks; OUT/plan.json.
struct Plan {
  std::vector<std::string> survey;  ///< absolute paths of what was given as the survey
  std::string session;              ///< absolute path of the journal; empty = none
  Recipe recipe;
  std::optional<PingSelection> pings;  ///< of each observation; empty = all
  std::vector<PlanTask> tasks;
  Diagnostics notes;  ///< of the survey as a whole: copies, repeated pings, files that cannot be read; without folders
};

/// Whether an observation is long enough to have some of these pings; empty = all.
[[nodiscard]] bool has_pings(const PlanTask& task, const std::optional<PingSelection>& pings);

/// What is to be done for one observation.
[[nodiscard]] PlanTask task_of(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                               const ObserveOptions& options);
/// What a plan says beside its tasks.
[[nodiscard]] Plan plan_without_tasks(const SurveyFiles& survey, std::span<const std::filesystem::path> paths,
                                      const std::filesystem::path& session, const Recipe& recipe,
                                      const ObserveOptions& options);
/// From headers only.
[[nodiscard]] Plan make_plan(const SurveyFiles& survey, std::span<const std::filesystem::path> paths,
                             const std::filesystem::path& session, const Recipe& recipe, const ObserveOptions& options);
[[nodiscard]] std::string plan_text(const Plan& plan);
/// errors  format, newer_version
[[nodiscard]] Result<Plan> plan_from_text(std::string_view text);
/// errors  also not_found, io
[[nodiscard]] Result<Plan> read_plan(const std::filesystem::path& path);
/// The survey that a work folder's products were made of; empty where no plan.json is there.
/// errors  as read_plan()
[[nodiscard]] Result<std::vector<std::filesystem::path>> planned_survey(const std::filesystem::path& out);

}  // namespace sonar
