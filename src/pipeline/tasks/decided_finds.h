// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <span>

#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/work_folders.h"

namespace sonar {

/// What find_of_another_version() is for runs that were given decisions, of whatever version: by observation, where the run's
/// journal has no line, not even one that was taken back, that could have changed a mask, so that the product's masks are
/// those that were found. A journal that is gone, or that has broken lines, says nothing of that.
/// known  observations that are not asked for
[[nodiscard]] std::map<std::size_t, OtherFind> finds_of_decided_runs(
    std::span<const std::filesystem::path> work_folders, const SurveyFiles& survey, const Recipe& recipe,
    const std::set<std::size_t>& known);

}  // namespace sonar
