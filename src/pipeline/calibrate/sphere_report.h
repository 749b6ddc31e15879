// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pipeline/calibrate/sphere_calibration.h"

namespace sonar {

/// The calibration table of the beams that were crossed; the others have no line, so that they stay as they were. Columns
/// as `run --calibration` reads them.
[[nodiscard]] std::string calibration_csv(const SphereCalibration& made);

/// What was found, a line for each fan, and the beams that stay as they were; every_beam: a line for each beam too.
[[nodiscard]] std::string calibration_text(const SphereCalibration& made, const SphereRunParams& params,
                                           bool every_beam);

/// The same as one JSON object, beams as they were and are, and the residuals.
[[nodiscard]] std::string calibration_json_text(const SphereCalibration& made, const SphereRunParams& params);

}  // namespace sonar
