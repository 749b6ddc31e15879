// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session/lists/document_rows.h"

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

/// The same of the observation on show, under the calibration that is chosen.
class CalibrationTable : public DocumentRows {
 public:
  explicit CalibrationTable(Workspace& workspace);

  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return beams_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override;
  [[nodiscard]] std::string example_limit() const override { return "gain<20"; }

 protected:
  void make() override;
  void school_selected() override {}

 private:
  std::vector<ListColumn> titles_;
  std::vector<BeamInForce> beams_;
};

}  // namespace sonar
