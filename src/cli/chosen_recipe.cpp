// SPDX-License-Identifier: Apache-2.0
#include "cli/chosen_recipe.h"

namespace sonar {

Result<Recipe> chosen_recipe(const std::string& recipe, const std::string& calibration) {
  auto chosen = named_recipe(recipe);
  if (!chosen || calibration.empty()) return chosen;
  if (auto taken = take_calibration_file(*chosen, calibration); !taken) return pass_on(taken);
  return chosen;
}

}  // namespace sonar
