// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

// OUT of `sonarx run` can be opened like the survey that it was made of.

/// What was named to be opened, told apart.
struct NamedToOpen {
  std::vector<std::filesystem::path> raw;           ///< files, and folders of them
  std::vector<std::filesystem::path> work_folders;  ///< results of runs on them
  std::optional<Recipe> recipe;                     ///< of the first run whose recipe is known
  /// Why no raw files are known that the results are of, in a line: what products hold is all there is. Empty = `raw` are.
  std::string raw_gone{};
  std::vector<std::filesystem::path> expected{};  ///< where the runs found them; empty = not told
  std::vector<std::filesystem::path> sessions{};  ///< journals, or folders of them, whose decisions the runs were given
};

/// A work folder stands for the raw files that its plan names, unless others are named beside it.
/// errors  not_found: those are gone, and those of another folder are there, or there are no products; as read_plan()
[[nodiscard]] Result<NamedToOpen> told_apart(std::span<const std::filesystem::path> paths);

/// Where paths lead, links followed: one name for one place.
[[nodiscard]] std::set<std::filesystem::path> places_of(std::span<const std::filesystem::path> paths);

/// Refuses a folder for a run's results that holds others: of another survey, of a session's decisions, or of no run at all.
/// survey  folders of raw files, or raw files
/// errors  usage; as read_plan()
[[nodiscard]] Result<void> require_results_of(const std::filesystem::path& out,
                                              std::span<const std::filesystem::path> survey);

/// The product of an observation, or what a run kept of its find, made from the same pings so; empty where no folder has it.
/// key  observation_key() of them
[[nodiscard]] std::filesystem::path product_in(std::span<const std::filesystem::path> work_folders,
                                               const std::string& observation, const std::string& key);

}  // namespace sonar
