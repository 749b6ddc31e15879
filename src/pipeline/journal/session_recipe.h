// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "base/result.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

// A recipe that a human chose for a survey lies beside its journals, as session-recipe.json: windows open the survey under it, and
// a run that follows the session uses it.

/// Of the last folder that has one; empty where none was chosen.
/// folders  as session_folders() gives them
/// errors  as read_recipe()
[[nodiscard]] Result<std::optional<Recipe>> kept_recipe(std::span<const std::filesystem::path> folders);
/// Makes the folder where needed.
/// errors  io, no_space
[[nodiscard]] Result<void> keep_recipe(const std::filesystem::path& folder, Recipe recipe);

}  // namespace sonar
