// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/calibrate/sphere_calibration.h"

namespace sonar {

/// The calibration table of the beams that were crossed; the others have no line, so that they stay as they were. Columns
/// as `run --calibration` reads them.
[[nodiscard]] std::string calibration_csv(const SphereCalibration& made);

/// The same table written, a new file or in place of an old one.
/// errors  as AtomicFile
[[nodiscard]] Result<void> write_calibration(const SphereCalibration& made, const std::filesystem::path& file);

/// The same table laid over a calibration: what `run --calibration` makes of it.
[[nodiscard]] CalibrationParams taken_calibration(const SphereCalibration& made, CalibrationParams over);

/// Weighted alike, of the levels of one beam that took part; unknown where none did.
[[nodiscard]] double residual_rms_db(const SphereCalibration& made, const CalibratedBeam& beam);

/// What was found, a line for each fan, and the beams that stay as they were; every_beam: a line for each beam too.
[[nodiscard]] std::string calibration_text(const SphereCalibration& made, const SphereRunParams& params,
                                           bool every_beam);

/// The same as one JSON object, beams as they were and are, and the residuals.
[[nodiscard]] std::string calibration_json_text(const SphereCalibration& made, const SphereRunParams& params);

}  // namespace sonar
