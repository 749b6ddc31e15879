// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/tasks/plan.h"

namespace sonar {

/// What `run` is asked for, beside the plan.
struct RunOptions {
  std::filesystem::path out;
  std::optional<std::string> only;     ///< one observation
  std::optional<std::size_t> task;     ///< one task of the plan
  std::optional<PingSelection> pings;  ///< empty = all
  bool remeasure = false;              ///< keep the masks of the products that are there
  std::string program_version;
};

/// Stage of run_plan()'s progress: how many observations are done, of how many; all of them when it ends.
inline constexpr std::string_view kObservations = "observations";

struct RunFailure {
  std::optional<std::string> observation;  ///< none: a file that gave nothing, named by the error
  Error error;
};

struct RunReport {
  std::vector<std::string> done;
  std::vector<std::string> skipped;  ///< their products were right already
  std::vector<RunFailure> failures;
};

/// Where the product of an observation lies below OUT.
[[nodiscard]] std::filesystem::path product_path(const std::filesystem::path& out, const std::string& observation);

/// Where what was found in an observation lies if its product holds decisions: one like it, without them.
[[nodiscard]] std::filesystem::path found_path(const std::filesystem::path& out, const std::string& observation);

/// Whether the plan has what is asked for: to be known before anything is written.
/// errors   usage: no such observation or task, or no such ping in it
[[nodiscard]] Result<void> require_possible(const Plan& plan, const RunOptions& options);

/// Works through the plan's tasks (or the chosen one): makes each product that is not there or not right, atomically.
/// A failed observation does not stop the others. Progress tells a stage kObservations as each one begins.
/// survey   opened from plan.survey with plan.recipe
/// errors   usage: no such observation or task; no_space; cancelled (what was finished stays)
[[nodiscard]] Result<RunReport> run_plan(const Plan& plan, const SurveyFiles& survey, const ReadJournal& journal,
                                         const RunOptions& options, Work& work);

}  // namespace sonar
