// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/channel_sv.h"

#include <algorithm>
#include <utility>

#include "base/units.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/beam_figures.h"
#include "pipeline/survey/calibration.h"
#include "signal/calibrate.h"

namespace sonar {
namespace {

constexpr std::int16_t kMissing = -20000;

/// From the first sample on; what was not stored has no data.
/// most  samples of any channel of the observation
std::vector<std::int16_t> power_of(const ChannelPing& head, int most) {
  std::vector<std::int16_t> out(static_cast<std::size_t>(std::clamp(head.offset, 0, std::max(0, most))), kNoData);
  out.reserve(out.size() + head.power_count.size());
  for (const std::int16_t count : head.power_count) {
    out.push_back(count == kMissing ? kNoData : std::clamp(count, kMinCount, kMaxCount));
  }
  return out;
}

ChannelTransmit settings_of(const ChannelPing& head) {
  ChannelTransmit settings;
  settings.frequency_hz = head.frequency_hz;
  settings.pulse_length_s = head.pulse_length_s;
  settings.sample_interval_s = head.sample_interval_s;
  settings.sound_speed_mps = head.sound_speed_mps;
  return settings;
}

}  // namespace

RangeAxis channel_range(const ObservationFiles& observation, const SurveyParams& params,
                        const ChannelTransmit& settings, int samples) {
  const double speed_mps = observation.sound_speed_given ? observation.sound_speed_mps : settings.sound_speed_mps;
  return {-params.range_zero_pulses * speed_mps * settings.pulse_length_s, speed_mps * settings.sample_interval_s / 2.0,
          samples};
}

Result<ChannelSv> load_channel_sv(const SurveyFiles& survey, const ObservationFiles& observation,
                                  std::size_t ping_index, int channel, const Recipe& recipe) {
  auto ping = load_ping(survey, observation.pings[ping_index]);
  if (!ping) {
    Error error = ping.error();
    error.where.ping = static_cast<std::int64_t>(ping_index);
    return tl::unexpected<Error>(std::move(error));
  }
  ChannelSv out;
  out.time = ping->time;
  const auto head = std::find_if(ping->channels.begin(), ping->channels.end(),
                                 [channel](const ChannelPing& one) { return one.channel == channel; });
  const auto index = static_cast<std::size_t>(channel);
  if (head == ping->channels.end() || index >= observation.config.beams.size()) return out;
  out.counts = power_of(*head, observation.range.count);
  out.range = channel_range(observation, recipe.survey, settings_of(*head), static_cast<int>(out.counts.size()));
  const double given_mps = observation.sound_speed_given ? observation.sound_speed_mps : 0.0;
  // A table's lines name channels, not sounders: beside a sonar with fans they are the sonar's.
  const auto& all = survey.observations;
  const bool of_sonar = std::any_of(all.begin(), all.end(), [](const auto& one) { return one.grid.has_value(); });
  const UserCalibration users(of_sonar ? std::vector<BeamCalibration>{} : recipe.calibration.beams);
  const ChannelCalibration calibration =
      channel_calibration(observation.config.beams[index], *head, recipe.calibration, users.of(channel), given_mps);
  const SampleRanges ranges(out.range.first_m, out.range.spacing_m, out.range.count);
  apply_sv_table(out.counts, sv_table(calibration, ranges));
  return out;
}

}  // namespace sonar
