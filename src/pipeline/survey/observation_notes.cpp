// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/observation_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonar {
namespace {

// At 300 m a beam that is 2 degrees off lies 10 m off.
constexpr double kLargeAttitude_deg = 2.0;

}  // namespace

void mark_silent_pings(const SurveyFiles& survey, ObservationFiles& observation) {
  std::int64_t silent = 0;
  std::int64_t first = -1;
  for (std::size_t i = 0; i < observation.pings.size(); ++i) {
    const std::vector<SurveyPing> parts = survey.parts(observation.pings[i]);
    const bool is_silent = std::all_of(parts.begin(), parts.end(), [&](const SurveyPing& part) {
      return survey.entry(part).silent_channels >= survey.entry(part).channels;
    });
    if (!is_silent) continue;
    observation.navigation[i].bad = true;
    if (silent++ == 0) first = static_cast<std::int64_t>(i);
  }
  if (silent == 0) return;
  observation.diagnostics.push_back(
      {DiagnosticCode::passive_pings, "", -1, first,
       fmt::format("{} of {} pings were made without transmitting, or as a test; they are marked bad, the first here",
                   silent, observation.pings.size())});
}

void note_missing_channels(const SurveyFiles& survey, ObservationFiles& observation) {
  if (!observation.grid) return;
  std::size_t missing = 0;
  std::size_t pings = 0;
  std::int64_t first = -1;
  for (std::size_t i = 0; i < observation.pings.size(); ++i) {
    std::size_t channels = 0;
    bool reduced = false;
    for (const SurveyPing& part : survey.parts(observation.pings[i])) {
      channels += survey.entry(part).channels;
      reduced = reduced || survey.entry(part).reduced;
    }
    if (reduced || channels >= observation.config.beams.size()) continue;
    missing += observation.config.beams.size() - channels;
    if (pings++ == 0) first = static_cast<std::int64_t>(i);
  }
  if (pings == 0) return;
  observation.diagnostics.push_back({DiagnosticCode::channels_missing, "", -1, first,
                                     fmt::format("{} of {} pings lack channels, {} in all, the first here", pings,
                                                 observation.pings.size(), missing)});
}

void note_unused_attitude(ObservationFiles& observation) {
  if (observation.config.kind != SounderKind::unknown || !observation.grid) return;
  const auto largest = [&](double PingNavigation::*angle_deg) {
    double most = 0.0;
    for (const PingNavigation& ping : observation.navigation) most = std::max(most, std::abs(ping.*angle_deg));
    return most;
  };
  const double roll_deg = largest(&PingNavigation::roll_deg);
  const double pitch_deg = largest(&PingNavigation::pitch_deg);
  if (std::max(roll_deg, pitch_deg) < kLargeAttitude_deg) return;
  observation.diagnostics.push_back(
      {DiagnosticCode::attitude_unused, "", -1, -1,
       fmt::format(
           "sounder '{}' is not known; its beams are taken as stabilised although the ship rolls by up to {:.1f} "
           "and pitches by up to {:.1f} degrees: set navigation.beams_stabilised to false if they are not",
           observation.config.sounder_name, roll_deg, pitch_deg)});
}

}  // namespace sonar
