// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pipeline/recipe.h"

namespace sonar {

inline constexpr const char* kCalibrationHelp =
    "CSV channel,gain_db,sa_correction_db,extra_factor_db; taken into the recipe";

/// The recipe of a file or preset (empty = default) with a calibration table taken into it (empty = none).
/// errors  as named_recipe() and take_calibration_file(); format, too, where a file names a value out of range
[[nodiscard]] Result<Recipe> chosen_recipe(const std::string& recipe, const std::string& calibration);
/// errors  as take_calibration_file()
[[nodiscard]] Result<Recipe> with_calibration(Recipe recipe, const std::string& calibration);

}  // namespace sonar
