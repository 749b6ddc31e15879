// SPDX-License-Identifier: Apache-2.0
#include "session/lists/calibration_table.h"

#include <cmath>
#include <cstddef>

#include "pipeline/survey/calibration.h"
#include "session/lists/cells.h"

namespace sonar {
namespace {

constexpr const char* kRawFile = "raw file";
constexpr double kPerKm = 1000.0;

std::string psi_from(const CalibrationParams& params, const BeamCalibration* line, const std::string& from_table) {
  if (params.psi == PsiSource::from_widths) return "widths";
  const bool told = params.psi == PsiSource::table && line != nullptr && std::isfinite(line->psi_db);
  return told ? from_table : kRawFile;
}

std::string absorption_from(const CalibrationParams& params, double recorded_db_per_m) {
  if (params.absorption == AbsorptionSource::ainslie_mccolm) return "Ainslie & McColm";
  const bool recorded = recorded_db_per_m > 0.0 && std::isfinite(recorded_db_per_m);
  return params.absorption == AbsorptionSource::file && recorded ? kRawFile : "Francois & Garrison";
}

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

std::vector<BeamInForce> calibration_in_force(const ObservationFiles& observation, const CalibrationParams& params,
                                              const std::string& from_table) {
  std::vector<BeamInForce> all;
  if (!observation.grid) return all;
  const UserCalibration table(params.beams);
  const double given_mps = observation.sound_speed_given ? observation.sound_speed_mps : 0.0;
  const int beams = observation.grid->beams();
  for (std::size_t row = 0; row < observation.grid->channel.size(); ++row) {
    const int channel = observation.grid->channel[row];
    if (channel < 0) continue;
    const ChannelPing head = first_head(observation, static_cast<std::size_t>(channel));
    const BeamCalibration* line = table.of(channel);
    const ChannelCalibration figures =
        channel_calibration(observation.config.beams[static_cast<std::size_t>(channel)], head, params, line, given_mps);
    const auto from = [&](double told) {
      return line != nullptr && std::isfinite(told) ? from_table : std::string(kRawFile);
    };
    const BeamCalibration told = line == nullptr ? BeamCalibration{} : *line;
    all.push_back({channel, static_cast<int>(row) / beams, static_cast<int>(row) % beams, figures.frequency_hz,
                   figures.pulse_length_s, figures.sound_speed_mps, figures.gain_db, figures.sa_correction_db,
                   figures.extra_factor_db, figures.equivalent_beam_angle_db, figures.absorption_db_per_m,
                   from(told.gain_db), from(told.sa_correction_db), psi_from(params, line, from_table),
                   absorption_from(params, head.absorption_db_per_m)});
  }
  return all;
}

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
