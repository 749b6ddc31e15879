// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// A user's calibration file, by channel.
class UserCalibration {
 public:
  explicit UserCalibration(std::vector<BeamCalibration> beams);
  /// Null where the file has no such line.
  [[nodiscard]] const BeamCalibration* of(int channel) const;

 private:
  std::vector<BeamCalibration> beams_;  // rising
};

/// Equivalent beam angle of a beam by the recipe's choice, dB re 1 sr; NaN = unknown.
/// user  null = the file has no line of it
[[nodiscard]] double psi_db_of(const BeamConfig& beam, const CalibrationParams& params, const BeamCalibration* user);

/// The grid with a user's widths in place of the raw file's.
[[nodiscard]] BeamGrid calibrated_grid(const BeamGrid& grid, const CalibrationParams& params);

/// How far backscatter may be off by what is known of each beam, all [fan][beam], dB; NaN = not known.
struct BeamFigures {
  std::vector<double> psi_used_db;  ///< dB re 1 sr
  /// Echo under the angle that was used over that under the other reading of it: the widths' where the stated or the
  /// calibrated one is used, the stated one where the widths' is. Negative = too low if the other one is right.
  std::vector<double> psi_error_db;
  /// Standard error of Sv by those of the calibration file: gain and sa correction count twice.
  std::vector<double> calibration_se_db;
};
/// grid  calibrated_grid()'s
[[nodiscard]] BeamFigures beam_figures(const SounderConfig& config, const BeamGrid& grid,
                                       const CalibrationParams& params);

/// What a product says of the observation's grid. The observation has one.
[[nodiscard]] GridRecord grid_record(const ObservationFiles& observation, const CalibrationParams& params);

}  // namespace sonar
