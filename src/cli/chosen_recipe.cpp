// SPDX-License-Identifier: Apache-2.0
#include "cli/chosen_recipe.h"

#include <utility>

namespace sonar {
namespace {

/// What a file says is no wrong usage of the verb that reads it, whatever is wrong with it.
Error of_file(Error error) {
  if (error.code == ErrorCode::bad_parameter) error.code = ErrorCode::format;
  return error;
}

}  // namespace

Result<Recipe> chosen_recipe(const std::string& recipe, const std::string& calibration) {
  auto chosen = named_recipe(recipe);
  if (!chosen) return tl::unexpected(of_file(std::move(chosen.error())));
  return with_calibration(std::move(*chosen), calibration);
}

Result<Recipe> with_calibration(Recipe recipe, const std::string& calibration) {
  if (calibration.empty()) return recipe;
  auto taken = take_calibration_file(recipe, calibration);
  if (!taken) return tl::unexpected(of_file(std::move(taken.error())));
  return recipe;
}

}  // namespace sonar
