// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "base/check.h"
#include "base/hash.h"
#include "base/units.h"
#include "pipeline/survey/clock_runs.h"
#include "pipeline/survey/observation_notes.h"
#include "pipeline/survey/sound_speeds.h"

namespace sonar {
namespace {

// One ping on its grid may take this many samples; a hostile channel must not ask for more.
constexpr std::int64_t kMaxVolumeSamples = std::int64_t{1} << 27;

TimeNs ns_of(double seconds) { return static_cast<TimeNs>(std::llround(seconds * 1e9)); }

template <class T>
void add(Hasher& hasher, const T& value) {
  hasher.add(std::as_bytes(std::span(&value, 1)));
}

/// What changed between two settings that may not change inside an observation; empty = nothing.
std::string setting_change(const TransmitSet& a, const TransmitSet& b) {
  for (std::size_t c = 0; c < std::min(a.size(), b.size()); ++c) {
    if (!a[c].seen() || !b[c].seen()) continue;
    const auto changed = [&](const char* what, double from, double to, const char* unit) {
      return fmt::format("channel {}: {} {} -> {} {}", c + 1, what, from, to, unit);
    };
    if (a[c].sample_interval_s != b[c].sample_interval_s) {
      return changed("sample interval", a[c].sample_interval_s, b[c].sample_interval_s, "s");
    }
    if (a[c].pulse_length_s != b[c].pulse_length_s) {
      return changed("pulse length", a[c].pulse_length_s, b[c].pulse_length_s, "s");
    }
    if (a[c].frequency_hz != b[c].frequency_hz) {
      return changed("frequency", a[c].frequency_hz, b[c].frequency_hz, "Hz");
    }
  }
  return {};
}

bool gives_speed(const SurveyParams& params) {
  return params.sound_speed_mps > 0.0 || !params.sound_speed_profile.empty();
}

/// Why a ping cannot go on the observation that began with another.
class Cutter {
 public:
  Cutter(const SurveyFiles& survey, const SurveyParams& params)
      : survey_(survey),
        gap_(ns_of(params.observation_gap_s)),
        longest_(survey.from_ends ? 0 : ns_of(params.observation_max_s)),
        given_speed_(gives_speed(params)) {
    for (const SurveyFile& file : survey.files) {
      configs_.emplace_back();
      for (const SounderConfig& config : file.index.configs) configs_.back().push_back(identity(config));
    }
  }

  /// first, before: pings of the running observation; next: the one in question. True = a new one begins.
  bool cut(const SurveyPing& first, const SurveyPing& before, const SurveyPing& next, ObservationFiles& fresh) {
    const PingEntry& f = survey_.entry(first);
    const PingEntry& b = survey_.entry(before);
    const PingEntry& n = survey_.entry(next);
    const auto note = [&](DiagnosticCode code, std::string text) {
      fresh.diagnostics.push_back(
          {code, survey_.files[next.file].index.name, static_cast<std::int64_t>(n.offset), 0, std::move(text)});
    };
    bool cut = false;
    if (n.time < b.time) {
      note(DiagnosticCode::time_back, fmt::format("{} after {}", iso_time(n.time), iso_time(b.time)));
      cut = true;
    }
    if (configs_[first.file][f.config] != configs_[next.file][n.config]) {
      note(DiagnosticCode::grid_changed, "the beams' configuration differs from the observation before");
      cut = true;
    } else if (const std::string& change = change_between(first, next); !change.empty()) {
      note(DiagnosticCode::settings_changed, change);
      cut = true;
    }
    const bool between_ends = survey_.from_ends && before.file == next.file;
    if (n.time - b.time > gap_ && !between_ends) cut = true;
    if (cut) return true;
    fresh.continues_cut = longest_ > 0 && n.time - f.time > longest_;
    if (given_speed_) {
      // Whatever the files say, all ranges are alike.
    } else if (const std::string& drift = drift_to(first, next); !drift.empty()) {
      note(DiagnosticCode::settings_changed, drift);
      fresh.continues_cut = true;  // the sea and its schools go on
    }
    if (fresh.continues_cut) fresh.cut_after = b.time;
    return fresh.continues_cut;
  }

 private:
  const std::string& change_between(const SurveyPing& first, const SurveyPing& next) {
    const auto key = [&](const SurveyPing& ping) { return std::pair(ping.file, survey_.entry(ping).transmit); };
    if (compared_ != std::optional(std::pair(key(first), key(next)))) {
      compared_ = std::pair(key(first), key(next));
      change_ = setting_change(survey_.files[first.file].index.transmits[survey_.entry(first).transmit],
                               survey_.files[next.file].index.transmits[survey_.entry(next).transmit]);
    }
    return change_;
  }

  /// Why the ping's ranges do not fit the running observation's; empty = they do.
  const std::string& drift_to(const SurveyPing& first, const SurveyPing& next) {
    if (drift_of_ != std::optional(first)) {
      drift_of_ = first;
      speeds_ = {};
      taken_.clear();
      take_speeds(first);
    }
    return take_speeds(next);
  }

  const std::string& take_speeds(const SurveyPing& ping) {
    const SetKey key{ping.file, survey_.entry(ping).transmit};
    drift_.clear();
    if (!taken_.contains(key)) {
      drift_ = speeds_.take(survey_.transmit(ping));
      if (drift_.empty()) taken_.insert(key);
    }
    return drift_;
  }

  using SetKey = std::pair<std::uint32_t, std::uint16_t>;
  const SurveyFiles& survey_;
  TimeNs gap_;
  TimeNs longest_;
  bool given_speed_;
  std::vector<std::vector<Hash128>> configs_;  // [file][config]
  std::optional<std::pair<SetKey, SetKey>> compared_;
  std::string change_;
  std::optional<SurveyPing> drift_of_;  // first ping of the observation that speeds_ is of
  SoundSpeeds speeds_;
  std::set<SetKey> taken_;
  std::string drift_;
};

/// Settings that the observation's pings were made with: file, index in its transmits.
std::set<std::pair<std::uint32_t, std::uint16_t>> settings_of(const SurveyFiles& survey,
                                                              const ObservationFiles& observation) {
  std::set<std::pair<std::uint32_t, std::uint16_t>> sets;
  for (const SurveyPing& ping : observation.pings) {
    for (const SurveyPing& part : survey.parts(ping)) sets.insert({part.file, survey.entry(part).transmit});
  }
  return sets;
}

/// Half way between the slowest and the fastest of the observation's pings.
double middle_sound_speed_mps(const SurveyFiles& survey, ObservationFiles& observation) {
  SoundSpeeds speeds;
  for (const auto& [file, transmit] : settings_of(survey, observation)) {
    speeds.take(survey.files[file].index.transmits[transmit]);
  }
  if (std::string drift = speeds.drift(); !drift.empty()) {
    observation.diagnostics.push_back({DiagnosticCode::sound_speed_drift, "", -1, -1, std::move(drift)});
  }
  return speeds.middle_mps();
}

/// A user's sound speed. Of a profile the mean down to where the deepest beam ends: slanting or level, beams that end
/// higher up are that much less right.
double given_sound_speed_mps(const SurveyParams& params, const ObservationFiles& observation, double transducer_depth_m,
                             double reach_m) {
  if (params.sound_speed_mps > 0.0) return params.sound_speed_mps;
  const double lowest_deg = observation.grid ? std::min(observation.grid->elevation_deg.front(), 0.0) : 0.0;
  return harmonic_mean_mps(params.sound_speed_profile, transducer_depth_m,
                           transducer_depth_m - reach_m * std::sin(rad_from_deg(lowest_deg)));
}

/// Longest rows of each channel.
std::vector<std::int32_t> channel_samples(const SurveyFiles& survey, const ObservationFiles& observation) {
  std::vector<std::int32_t> longest;
  for (const auto& [file, transmit] : settings_of(survey, observation)) {
    const TransmitSet& set = survey.files[file].index.transmits[transmit];
    longest.resize(std::max(longest.size(), set.size()), 0);
    for (std::size_t c = 0; c < set.size(); ++c) longest[c] = std::max(longest[c], set[c].max_samples);
  }
  return longest;
}

/// Settings of a ping's channels, wherever they lie.
TransmitSet transmit_of(const SurveyFiles& survey, const SurveyPing& ping) {
  TransmitSet set;
  for (const SurveyPing& part : survey.parts(ping)) {
    const TransmitSet& of_part = survey.transmit(part);
    set.resize(std::max(set.size(), of_part.size()));
    for (std::size_t c = 0; c < of_part.size(); ++c) {
      if (!set[c].seen()) set[c] = of_part[c];
    }
  }
  return set;
}

/// Why rows of these channels cannot share one range axis; empty = they can.
std::string no_common_range(const TransmitSet& set, const ChannelTransmit& reference, bool given_speed) {
  for (std::size_t c = 0; c < set.size(); ++c) {
    if (!set[c].seen()) continue;
    const double spacing = (given_speed ? 1.0 : set[c].sound_speed_mps) * set[c].sample_interval_s;
    const double expected = (given_speed ? 1.0 : reference.sound_speed_mps) * reference.sample_interval_s;
    if (std::abs(spacing - expected) > 1e-6 * expected || set[c].pulse_length_s != reference.pulse_length_s) {
      return fmt::format("channel {} has another sample spacing or pulse than the first", c + 1);
    }
  }
  return {};
}

void complete_range(const SurveyFiles& survey, ObservationFiles& observation, const SurveyParams& params,
                    double transducer_depth_m) {
  const auto reference = std::find_if(observation.transmit.begin(), observation.transmit.end(),
                                      [](const ChannelTransmit& t) { return t.seen(); });
  // Every ping has a channel, and its setting is in the set.
  SONAR_CHECK(reference != observation.transmit.end());
  observation.sample_interval_s = reference->sample_interval_s;
  observation.pulse_length_s = reference->pulse_length_s;
  const std::vector<std::int32_t> longest = channel_samples(survey, observation);
  observation.sound_speed_given = gives_speed(params);
  if (observation.sound_speed_given) {
    const double reach_m = *std::max_element(longest.begin(), longest.end()) * reference->sound_speed_mps *
                           reference->sample_interval_s / 2.0;
    observation.sound_speed_mps = given_sound_speed_mps(params, observation, transducer_depth_m, reach_m);
  } else {
    observation.sound_speed_mps = middle_sound_speed_mps(survey, observation);
  }
  const double spacing = observation.sound_speed_mps * reference->sample_interval_s / 2.0;
  const double zero = params.range_zero_pulses * observation.sound_speed_mps * reference->pulse_length_s;
  observation.range = {-zero, spacing, *std::max_element(longest.begin(), longest.end())};
  if (!observation.grid) return;
  const BeamGrid& grid = *observation.grid;
  std::string problem = no_common_range(observation.transmit, *reference, observation.sound_speed_given);
  const auto rows = static_cast<std::int64_t>(grid.channel.size());
  if (problem.empty() && rows * observation.range.count > kMaxVolumeSamples) {
    problem = fmt::format("{} beams of {} samples are too many", rows, observation.range.count);
  }
  if (!problem.empty()) {
    observation.grid.reset();
    observation.diagnostics.push_back({DiagnosticCode::no_common_range, "", -1, -1, problem});
    return;
  }
  observation.sample_count.assign(static_cast<std::size_t>(grid.fans()), 0);
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    const auto c = static_cast<std::size_t>(grid.channel[row]);
    auto& count = observation.sample_count[row / static_cast<std::size_t>(grid.beams())];
    if (c < longest.size()) count = std::max(count, longest[c]);
  }
}

/// Beam directions with azimuths that count clockwise, whichever way the file counts them.
SounderConfig with_sense(SounderConfig config, BeamAzimuthSense sense) {
  if (sense == BeamAzimuthSense::clockwise) return config;
  for (BeamConfig& beam : config.beams) beam.direction_deg[1] = -beam.direction_deg[1];
  return config;
}

}  // namespace

Hash128 identity(const SounderConfig& config) {
  Hasher hasher;
  add(hasher, config.gps_offset_m);
  for (const BeamConfig& b : config.beams) {
    hasher.add(b.channel_id);
    add(hasher, b.beam_type);
    for (const double v :
         {b.frequency_hz, b.gain_db, b.equivalent_beam_angle_db, b.width_alongship_deg, b.width_athwartship_deg,
          b.sensitivity_alongship, b.sensitivity_athwartship, b.offset_alongship_deg, b.offset_athwartship_deg}) {
      add(hasher, v);
    }
    add(hasher, b.position_m);
    add(hasher, b.direction_deg);
    add(hasher, b.pulse_length_s);
    add(hasher, b.gain_table_db);
    add(hasher, b.sa_correction_table_db);
  }
  return hasher.value();
}

std::vector<ObservationFiles> cut_sequence(const SurveyFiles& survey, const SounderSequence& sequence,
                                           const SurveyParams& params) {
  std::vector<ObservationFiles> observations;
  Cutter cutter(survey, params);
  for (const SurveyPing& ping : sequence.pings) {
    ObservationFiles fresh;
    const bool first = observations.empty();
    if (first || cutter.cut(observations.back().pings.front(), observations.back().pings.back(), ping, fresh)) {
      fresh.cut_notes = fresh.diagnostics.size();
      observations.push_back(std::move(fresh));
    }
    observations.back().pings.push_back(ping);
  }
  return observations;
}

void complete_observation(const SurveyFiles& survey, ObservationFiles& observation, const SurveyParams& params,
                          const NavigationParams& navigation) {
  const SurveyPing& first = observation.pings.front();
  const RawIndex& first_index = survey.files[first.file].index;
  observation.config = *first_index.configs[survey.entry(first).config];
  observation.transmit = transmit_of(survey, first);
  auto grid = derive_beam_grid(with_sense(observation.config, navigation.beam_azimuth_sense),
                               navigation.mounting_azimuth_deg, params.grid_tolerance_deg);
  if (grid) {
    observation.grid = std::move(*grid);
  } else {
    observation.diagnostics.push_back({DiagnosticCode::no_grid, "", -1, -1, grid.error().text});
  }
  const double recorded_depth_m = ping_attitude(survey.entry(first)).transducer_depth_m;
  complete_range(survey, observation, params,
                 recorded_depth_m != 0.0 ? recorded_depth_m : navigation.transducer_depth_m);

  std::vector<PingMotion> motions;
  ClockRunsOfFiles runs;
  for (const SurveyPing& ping : observation.pings) {
    motions.push_back(ping_attitude(survey.entry(ping)));
    auto& files = observation.files;
    for (const SurveyPing& part : survey.parts(ping)) {
      if (std::find(files.rbegin(), files.rend(), part.file) == files.rend()) files.push_back(part.file);
      runs[part.file].insert(survey.entry(part).clock_run);
    }
  }
  const SaidToPings said(survey, observation.files, runs);
  Navigation placed = navigate(said.series(), motions, observation.config, navigation);
  observation.navigation = std::move(placed.pings);
  if (!params.use_passive_pings) mark_silent_pings(survey, observation);
  note_missing_channels(survey, observation);
  if (navigation.beams_stabilised) note_unused_attitude(observation);
  observation.talkers = std::move(placed.talkers);
  observation.gps_minus_clock_s = placed.gps_minus_clock_s;
  for (Diagnostic& note : placed.diagnostics) {
    if (note.code == DiagnosticCode::position_jump && placed.first_jump) {
      note.file = survey.files[said.file_of(*placed.first_jump)].index.name;
    }
    observation.diagnostics.push_back(std::move(note));
  }
}

}  // namespace sonar
