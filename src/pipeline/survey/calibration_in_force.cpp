// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/calibration_in_force.h"

#include <cmath>
#include <cstddef>

#include "pipeline/survey/calibration.h"

namespace sonar {
namespace {

constexpr const char* kRawFile = "raw file";

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

}  // namespace sonar
