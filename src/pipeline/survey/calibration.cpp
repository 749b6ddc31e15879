// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "model/beam_angles.h"

namespace sonar {
namespace {

/// More sets than this in use at once means that every ping has its own: older tables are made again when needed.
constexpr std::size_t kMaxTables = 8;

struct GainPair {
  double gain_db;
  double sa_correction_db;
  bool matched;  ///< the sounder's table has the pulse
};

GainPair gain_of(const BeamConfig& beam, double pulse_length_s, double tolerance) {
  for (std::size_t i = 0; i < beam.pulse_length_s.size(); ++i) {
    const double tabled = beam.pulse_length_s[i];
    if (tabled > 0.0 && std::abs(tabled - pulse_length_s) <= tolerance * tabled) {
      return {beam.gain_table_db[i], beam.sa_correction_table_db[i], true};
    }
  }
  return {beam.gain_db, 0.0, false};
}

bool tells_absorption(const ChannelPing& head) {
  return head.absorption_db_per_m > 0.0 && std::isfinite(head.absorption_db_per_m);
}

double absorption_of(const ChannelPing& head, const CalibrationParams& params, double given_speed_mps) {
  switch (params.absorption) {
    case AbsorptionSource::file:
      if (tells_absorption(head)) return head.absorption_db_per_m;
      break;
    case AbsorptionSource::ainslie_mccolm:
      return absorption_ainslie_mccolm(head.frequency_hz, params.water);
    case AbsorptionSource::francois_garrison:
      break;
  }
  return absorption_francois_garrison(head.frequency_hz, params.water, given_speed_mps);
}

Hash128 settings_hash(std::span<const ChannelPing> heads) {
  Hasher hasher;
  for (const ChannelPing& head : heads) {
    const std::array<double, 6> numbers{static_cast<double>(head.channel),
                                        head.frequency_hz,
                                        head.transmit_power_w,
                                        head.pulse_length_s,
                                        head.sound_speed_mps,
                                        head.absorption_db_per_m};
    hasher.add(std::as_bytes(std::span(numbers)));
  }
  return hasher.value();
}

}  // namespace

ChannelCalibration channel_calibration(const BeamConfig& beam, const ChannelPing& head, const CalibrationParams& params,
                                       const BeamCalibration* beam_calibration, double given_speed_mps) {
  const GainPair gain = gain_of(beam, head.pulse_length_s, params.pulse_tolerance);
  ChannelCalibration calibration;
  calibration.frequency_hz = head.frequency_hz;
  calibration.absorption_db_per_m = absorption_of(head, params, given_speed_mps);
  calibration.transmit_power_w = head.transmit_power_w;
  calibration.pulse_length_s = head.pulse_length_s;
  calibration.sound_speed_mps = given_speed_mps > 0.0 ? given_speed_mps : head.sound_speed_mps;
  calibration.gain_db = gain.gain_db;
  calibration.sa_correction_db = gain.sa_correction_db;
  calibration.equivalent_beam_angle_db = psi_db_of(beam, params, beam_calibration);
  if (beam_calibration != nullptr) {
    const auto take = [](double& value, double from) {
      if (std::isfinite(from)) value = from;
    };
    take(calibration.gain_db, beam_calibration->gain_db);
    take(calibration.sa_correction_db, beam_calibration->sa_correction_db);
    take(calibration.extra_factor_db, beam_calibration->extra_factor_db);
  }
  return calibration;
}

ChannelPing first_head(const ObservationFiles& observation, std::size_t channel) {
  const ChannelTransmit& sent = observation.transmit[channel];
  ChannelPing head;
  head.channel = static_cast<int>(channel);
  head.frequency_hz = sent.frequency_hz;
  head.transmit_power_w = sent.transmit_power_w;
  head.pulse_length_s = sent.pulse_length_s;
  head.sound_speed_mps = sent.sound_speed_mps;
  head.absorption_db_per_m = sent.absorption_db_per_m;
  return head;
}

CalibrationTables::CalibrationTables(const ObservationFiles& observation, const CalibrationParams& params)
    : observation_(observation),
      params_(params),
      users_(params.beams),
      given_speed_mps_(observation.sound_speed_given ? observation.sound_speed_mps : 0.0),
      row_of_channel_(observation.grid->row_of_channel()) {}

CalibrationTables::Table CalibrationTables::of(std::span<const ChannelPing> heads) {
  const Hash128 key = settings_hash(heads);
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = tables_.find(key); found != tables_.end()) return found->second;
  }
  Table table = make(heads);
  const std::scoped_lock lock(mutex_);
  if (tables_.size() >= kMaxTables) tables_.clear();
  return tables_.emplace(key, std::move(table)).first->second;
}

CalibrationTables::Table CalibrationTables::of_first_ping() {
  std::vector<ChannelPing> heads;
  for (std::size_t channel = 0; channel < observation_.transmit.size(); ++channel) {
    heads.push_back(first_head(observation_, channel));
  }
  return of(heads);
}

CalibrationTables::Table CalibrationTables::make(std::span<const ChannelPing> heads) const {
  const RangeAxis& range = observation_.range;
  auto table = std::make_shared<Array3<std::int16_t>>(
      Shape3{observation_.grid->fans(), observation_.grid->beams(), range.count}, kNoData);
  const SampleRanges ranges(range.first_m, range.spacing_m, range.count);
  for (const ChannelPing& head : heads) {
    const auto channel = static_cast<std::size_t>(head.channel);
    if (channel >= row_of_channel_.size() || row_of_channel_[channel] < 0) continue;
    const ChannelCalibration calibration = channel_calibration(observation_.config.beams[channel], head, params_,
                                                               users_.of(head.channel), given_speed_mps_);
    const auto row = sv_table(calibration, ranges);
    std::copy(row.begin(), row.end(), table->view().row(row_of_channel_[channel]).begin());
  }
  return table;
}

void CalibrationTables::note_unmatched_gains(std::span<const std::size_t> channels, Diagnostics& notes) const {
  const auto unmatched = [&](std::size_t channel) {
    const BeamCalibration* user = users_.of(static_cast<int>(channel));
    const bool given = user != nullptr && std::isfinite(user->gain_db) && std::isfinite(user->sa_correction_db);
    return !given && !gain_of(observation_.config.beams[channel], observation_.transmit[channel].pulse_length_s,
                              params_.pulse_tolerance)
                          .matched;
  };
  const auto first = std::find_if(channels.begin(), channels.end(), unmatched);
  if (first == channels.end()) return;
  const BeamConfig& beam = observation_.config.beams[*first];
  std::string tabled;
  for (const double pulse_s : beam.pulse_length_s) {
    if (pulse_s > 0.0) tabled += fmt::format("{}{:.6g}", tabled.empty() ? "" : ", ", pulse_s * 1e3);
  }
  notes.push_back(
      {DiagnosticCode::gain_not_matched, "", -1, -1,
       fmt::format(
           "{} of {} channels, the first {}: the pulse is {:.6g} ms, the gain table has {}; the beam's own gain of "
           "{:.6g} dB is used without an sa correction, so that Sv may be wrong by some dB: use a calibration table",
           std::count_if(channels.begin(), channels.end(), unmatched), channels.size(), *first,
           observation_.transmit[*first].pulse_length_s * 1e3, tabled.empty() ? "none" : tabled + " ms",
           beam.gain_db)});
}

Diagnostics CalibrationTables::diagnostics() const {
  Diagnostics notes;
  for (const BeamCalibration& beam : params_.beams) {
    const auto channel = static_cast<std::size_t>(beam.channel);
    if (beam.channel >= 0 && channel < row_of_channel_.size() && row_of_channel_[channel] >= 0) continue;
    notes.push_back({DiagnosticCode::calibration_unused, "", -1, -1,
                     fmt::format("the calibration names channel {}, the grid has 0 to {}; that line has no effect",
                                 beam.channel, row_of_channel_.size() - 1)});
  }
  std::vector<std::size_t> sound;
  for (std::size_t channel = 0; channel < observation_.transmit.size(); ++channel) {
    if (!observation_.transmit[channel].seen() || channel >= observation_.config.beams.size()) continue;
    const ChannelPing head = first_head(observation_, channel);
    if (is_sound(channel_calibration(observation_.config.beams[channel], head, params_, users_.of(head.channel),
                                     given_speed_mps_))) {
      sound.push_back(channel);
      continue;
    }
    notes.push_back(
        {DiagnosticCode::not_calibrated, "", -1, -1,
         fmt::format("channel {}: gain, power, pulse, frequency or beam angle is missing; not used", channel)});
  }
  note_unmatched_gains(sound, notes);
  note_computed_absorption(sound, notes);
  note_impossible_psi(notes);
  return notes;
}

void CalibrationTables::note_impossible_psi(Diagnostics& notes) const {
  if (params_.psi != PsiSource::stated) return;
  const PsiExcess excess = excess_over(psi_excess_db(calibrated_grid(*observation_.grid, params_)));
  if (excess.impossible == 0) return;
  notes.push_back({DiagnosticCode::psi_against_widths, "", -1, -1,
                   text_of(excess) + "; calibration.psi chooses which is used, backscatter_psi_error_db gives the "
                                     "difference for each school"});
}

void CalibrationTables::note_computed_absorption(std::span<const std::size_t> channels, Diagnostics& notes) const {
  if (params_.absorption != AbsorptionSource::file) return;
  const auto computed = std::count_if(channels.begin(), channels.end(),
                                      [&](std::size_t c) { return !tells_absorption(first_head(observation_, c)); });
  if (computed == 0) return;
  const WaterProperties& water = params_.water;
  notes.push_back(
      {DiagnosticCode::absorption_computed, "", -1, -1,
       fmt::format("{} of {} channels: the files state no absorption; that of Francois & Garrison for {:g} C, {:g} "
                   "psu, {:g} m and pH {:g} is used",
                   computed, channels.size(), water.temperature_c, water.salinity_psu, water.depth_m, water.ph)});
}

}  // namespace sonar
