// SPDX-License-Identifier: Apache-2.0
#include "session/lists/calibration_table.h"

#include <cstddef>

#include "session/lists/cells.h"

namespace sonar {
namespace {

constexpr double kPerKm = 1000.0;

const std::vector<ColumnOf<BeamInForce>>& calibration_columns() {
  using B = BeamInForce;
  static const std::vector<ColumnOf<B>> kColumns{
      {{"Channel", "", "as calibration tables count them, from 0", true},
       [](const B& b) { return count_cell(b.channel); }},
      {{"Fan", "", "", true}, [](const B& b) { return count_cell(b.fan); }},
      {{"Beam", "", "", true}, [](const B& b) { return count_cell(b.beam); }},
      {{"Frequency", "kHz", "", true}, [](const B& b) { return number_cell(b.frequency_hz / 1e3, 1); }},
      {{"Pulse", "ms", "its nominal length", true}, [](const B& b) { return number_cell(b.pulse_length_s * 1e3, 3); }},
      {{"Gain", "dB", "on the axis", true}, [](const B& b) { return number_cell(b.gain_db, 2); }},
      {{"Gain from", "", "where the gain comes from", false}, [](const B& b) { return text_cell(b.gain_from); }},
      {{"Sa correction", "dB", "", true}, [](const B& b) { return number_cell(b.sa_correction_db, 2); }},
      {{"Sa from", "", "where the Sa correction comes from", false},
       [](const B& b) { return text_cell(b.sa_correction_from); }},
      {{"Psi", "dB re 1 sr", "equivalent beam angle", true}, [](const B& b) { return number_cell(b.psi_db, 2); }},
      {{"Psi from", "", "where the equivalent beam angle comes from", false},
       [](const B& b) { return text_cell(b.psi_from); }},
      {{"Absorption", "dB/km", "one way", true},
       [](const B& b) { return number_cell(b.absorption_db_per_m * kPerKm, 2); }},
      {{"Absorption from", "", "where the absorption comes from", false},
       [](const B& b) { return text_cell(b.absorption_from); }},
      {{"Extra factor", "dB", "added to Sv by a calibration table", true},
       [](const B& b) { return number_cell(b.extra_factor_db, 2); }},
      {{"Sound speed", "m/s", "that the sonar equation has", true},
       [](const B& b) { return number_cell(b.sound_speed_mps, 1); }},
  };
  return kColumns;
}

}  // namespace

CalibrationTable::CalibrationTable(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::observation}),
      titles_(titles_of(calibration_columns())) {
  make();
}

void CalibrationTable::make() {
  beams_.clear();
  const Document& document = workspace().document;
  const auto& shown = document.shown();
  if (!shown) return;
  beams_ = calibration_in_force(shown->files(), document.measuring_recipe().calibration,
                                shown->recalibrated() ? "chosen calibration" : "recipe");
}

Cell CalibrationTable::cell(std::size_t row, std::size_t column) const {
  return calibration_columns()[column].cell(beams_[row]);
}

}  // namespace sonar
