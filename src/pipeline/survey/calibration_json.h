// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

/// The lines of a calibration file; null = the raw file's value.
[[nodiscard]] nlohmann::json beams_to_json(const std::vector<BeamCalibration>& beams);
/// errors  format, bad_parameter: naming the line or the channel
[[nodiscard]] Result<std::vector<BeamCalibration>> beams_from_json(const nlohmann::json& list);
/// errors  bad_parameter: a channel that stands twice, a value that no sounder has
[[nodiscard]] Result<void> check_beams(const std::vector<BeamCalibration>& beams);

/// {"calibration": {...}, "beam_calibration": [...]}, named as in a recipe.
[[nodiscard]] nlohmann::json to_json(const CalibrationParams& calibration);
/// errors  format, bad_parameter: naming the parameter
[[nodiscard]] Result<CalibrationParams> calibration_from_json(const nlohmann::json& json);

/// A calibration that a user names: a table (channel,gain_db,...), which is laid over what the recipe says, or a recipe
/// (*.json), of which the calibration is taken.
/// errors  not_found, io, format, newer_version, bad_parameter
[[nodiscard]] Result<CalibrationParams> read_calibration(const std::string& path, const Recipe& recipe);

}  // namespace sonar
