// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What a beam's Sv is worked out with, and where each figure comes from: "raw file", "recipe", "chosen calibration",
/// "widths", or a formula.
struct BeamInForce {
  int channel = 0;  ///< as calibration tables count them, from 0
  int fan = 0;
  int beam = 0;
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  double sound_speed_mps = 0.0;
  double gain_db = 0.0;
  double sa_correction_db = 0.0;
  double extra_factor_db = 0.0;
  double psi_db = 0.0;               ///< dB re 1 sr
  double absorption_db_per_m = 0.0;  ///< one way
  std::string gain_from, sa_correction_from, psi_from, absorption_from;
};

/// Of every beam of an observation's grid, by the settings of its first ping.
/// from_table  what a line of params.beams is called
[[nodiscard]] std::vector<BeamInForce> calibration_in_force(const ObservationFiles& observation,
                                                            const CalibrationParams& params,
                                                            const std::string& from_table);

}  // namespace sonar
