// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

/// Angle between the fitted direction of the sphere in a level's ping and that of its beam, degrees.
/// level  of made.levels
[[nodiscard]] double off_axis_deg(const SphereCalibration& made, std::size_t level);

/// "tungsten carbide with 6 % cobalt, 38.1 mm"
[[nodiscard]] std::string sphere_text(const SphereRunParams& params);
/// "480 of 500 beams crossed; residuals 0.210 dB, of which ..."
[[nodiscard]] std::string crossed_text(const SphereCalibration& made);

/// What was found, a line for each fan, and the beams that stay as they were; every_beam: a line for each beam too.
[[nodiscard]] std::string calibration_text(const SphereCalibration& made, const SphereRunParams& params,
                                           bool every_beam);

/// The same as one JSON object, beams as they were and are, and the residuals.
[[nodiscard]] std::string calibration_json_text(const SphereCalibration& made, const SphereRunParams& params);

}  // namespace sonar
