// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/session_recipe.h"

#include <ranges>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"

namespace sonar {
namespace {

constexpr const char* kName = "session-recipe.json";

}  // namespace

Result<std::optional<Recipe>> kept_recipe(std::span<const std::filesystem::path> folders) {
  std::error_code absent;
  for (const std::filesystem::path& folder : std::views::reverse(folders)) {
    const std::filesystem::path file = folder / kName;
    if (!std::filesystem::exists(file, absent)) continue;
    auto recipe = read_recipe(file.string());
    // What a file says is no wrong usage, whatever is wrong with it.
    if (!recipe && recipe.error().code == ErrorCode::bad_parameter) recipe.error().code = ErrorCode::format;
    if (!recipe) return pass_on(recipe);
    return std::optional(std::move(*recipe));
  }
  return std::optional<Recipe>{};
}

Result<void> keep_recipe(const std::filesystem::path& folder, Recipe recipe) {
  recipe.automatic = true;  // for whoever runs it without the session
  if (auto own = require_own_folder(folder); !own) return own;
  return write_file(folder / kName, recipe_text(recipe), Beside::own_folder);
}

}  // namespace sonar
