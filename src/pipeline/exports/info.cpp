// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/info.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "io/ping_source.h"

namespace sonar {
namespace {

std::string sounder_of(const RawIndex& index) {
  std::string name;
  for (const SounderConfig& config : index.configs) {
    if (name.empty()) name = config.sounder_name;
  }
  return name;
}

void add_pings(const RawIndex& index, FileInfo& info) {
  info.pings = static_cast<std::int64_t>(index.pings.size());
  for (const PingEntry& ping : index.pings) {
    const bool first = info.max_samples == 0 && info.min_samples == 0;
    info.min_samples = first ? ping.min_samples : std::min<std::int64_t>(info.min_samples, ping.min_samples);
    info.max_samples = std::max<std::int64_t>(info.max_samples, ping.max_samples);
  }
  if (!index.pings.empty()) {
    info.first_time = index.pings.front().time;
    info.last_time = index.pings.back().time;
  } else if (!index.datagrams.empty()) {
    info.first_time = index.first_datagram_time;
    info.last_time = index.last_datagram_time;
  }
}

/// Of a file that cannot be read again nothing.
void add_unread(const SurveyFile& file, FileInfo& info) {
  const auto source = open_file(file.path);
  if (!source) return;
  const UnreadFormat unread = unread_format(**source, file.index.format);
  if (!unread.sounder.empty()) info.sounder = unread.sounder;
  info.channels = std::max(info.channels, unread.channels);
}

FileInfo file_info(const SurveyFile& file, const SurveyFiles& survey, const NavigationParams& navigation) {
  const RawIndex& index = file.index;
  FileInfo info;
  info.path = file.path.string();
  info.format = name(index.format);
  info.sounder = sounder_of(index);
  info.size = index.size;
  info.datagrams = index.datagrams;
  for (const SounderConfig& config : index.configs) {
    info.channels = std::max(info.channels, static_cast<std::int64_t>(config.beams.size()));
  }
  if (!index.gives_samples() && !survey.from_ends) add_unread(file, info);
  add_pings(index, info);
  std::vector<const NavSeries*> series;
  for (const NavSeries& s : index.navigation) series.push_back(&s);
  std::vector<PingMotion> motions;
  for (const PingEntry& ping : index.pings) motions.push_back(ping_attitude(ping));
  const Navigation placed =
      navigate(series, motions, index.configs.empty() ? SounderConfig{} : *index.configs.front(), navigation);
  info.talkers = placed.talkers;
  info.gps_minus_clock_s = placed.gps_minus_clock_s;
  if (const auto fixes = first_and_last_fix(series, navigation)) {
    // Of ends alone a fix is the first or the last only where it lies near.
    const auto near = [&](const NavSample& fix, const std::optional<TimeNs>& time) {
      return !survey.from_ends ||
             (time && std::abs(static_cast<double>(fix.time - *time)) <= navigation.fix_limit_s * 1e9);
    };
    const auto place = [](const NavSample& fix) { return Geographic{fix.first, fix.second}; };
    if (near(fixes->first, info.first_time)) info.first_position = place(fixes->first);
    if (near(fixes->second, info.last_time)) info.last_position = place(fixes->second);
  }
  info.notes = index.diagnostics;
  for (const Diagnostic& note : survey.diagnostics) {
    if (note.file == index.name) info.notes.push_back(note);
  }
  info.readable = !file.error && index.readable();
  return info;
}

Result<std::int64_t> power_count_sum(const SurveyFile& file, BlockPool& blocks, const Work& work) {
  const auto opened = open_file(file.path);
  if (!opened) return pass_on(opened);
  const auto source = stoppable(*opened, work);
  std::int64_t sum = 0;
  for (const PingEntry& entry : file.index.pings) {
    const auto ping = read_ping(*source, entry, blocks);
    if (!ping) return pass_on(ping);
    for (const ChannelPing& channel : ping->channels) {
      for (const std::int16_t count : channel.power_count) sum += count;
    }
  }
  return sum;
}

/// The gain that the sounder's table has for a pulse; the beam's own where the table does not know it.
double gain_for(const BeamConfig& beam, double pulse_length_s) {
  constexpr double kTolerance = 1e-3;
  for (std::size_t i = 0; i < beam.pulse_length_s.size(); ++i) {
    const double known_s = beam.pulse_length_s[i];
    if (known_s > 0.0 && std::abs(known_s - pulse_length_s) <= kTolerance * known_s) return beam.gain_table_db[i];
  }
  return beam.gain_db;
}

InstrumentInfo instrument_info(const ObservationFiles& observation) {
  InstrumentInfo info;
  info.model = model_of(observation.config);
  info.model_and_name = model_and_name(observation.config);
  info.beams = std::ssize(observation.config.beams);
  for (std::size_t i = 0; i < observation.config.beams.size(); ++i) {
    const BeamConfig& beam = observation.config.beams[i];
    const bool sent = i < observation.transmit.size() && observation.transmit[i].seen();
    info.frequency_hz.take(sent ? observation.transmit[i].frequency_hz : beam.frequency_hz);
    info.width_alongship_deg.take(beam.width_alongship_deg);
    info.width_athwartship_deg.take(beam.width_athwartship_deg);
    if (!sent) continue;
    info.pulse_length_s.take(observation.transmit[i].pulse_length_s);
    info.transmit_power_w.take(observation.transmit[i].transmit_power_w);
    info.gain_db.take(gain_for(beam, observation.transmit[i].pulse_length_s));
  }
  return info;
}

SurveyInfo::Observation observation_info(const SurveyFiles& survey, const ObservationFiles& observation) {
  SurveyInfo::Observation info;
  info.name = observation.name;
  for (const std::uint32_t f : observation.files) info.files.push_back(survey.files[f].path.filename().string());
  info.sounder = observation.config.sounder_name;
  info.instrument = instrument_info(observation);
  info.pings = static_cast<std::int64_t>(observation.pings.size());
  info.first_time = observation.navigation.front().time;
  info.last_time = observation.navigation.back().time;
  info.grid = observation.grid;
  info.continues_cut = observation.continues_cut;
  info.talkers = observation.talkers;
  info.notes = observation.diagnostics;
  return info;
}

}  // namespace

void SettingRange::take(double value) {
  if (!std::isfinite(value)) return;
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

bool SurveyInfo::all_readable() const {
  return std::all_of(files.begin(), files.end(), [](const FileInfo& file) { return file.readable; });
}

Result<SurveyInfo> survey_info(const SurveyFiles& survey, const NavigationParams& navigation, bool with_checksum,
                               Work& work) {
  SurveyInfo info;
  info.from_ends = survey.from_ends;
  for (const SurveyFile& file : survey.files) info.files.push_back(file_info(file, survey, navigation));
  for (const ObservationFiles& o : survey.observations) info.observations.push_back(observation_info(survey, o));
  if (!with_checksum) return info;
  std::vector<Result<std::int64_t>> sums(survey.files.size(), std::int64_t{0});
  work.for_each(static_cast<std::int64_t>(survey.files.size()), [&](std::int64_t i) {
    const auto f = static_cast<std::size_t>(i);
    if (survey.files[f].index.gives_samples()) sums[f] = power_count_sum(survey.files[f], *survey.blocks, work);
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped while summing");
  for (std::size_t f = 0; f < sums.size(); ++f) {
    if (!sums[f]) return pass_on(sums[f]);
    if (survey.files[f].index.gives_samples()) info.files[f].power_count_sum = *sums[f];
  }
  return info;
}

}  // namespace sonar
