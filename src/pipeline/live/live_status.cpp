// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/live_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

namespace sonar {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr TimeNs kMinute = 60 * kSecondNs;

double seconds(TimeNs time) { return static_cast<double>(time) / static_cast<double>(kSecondNs); }

double rate(const SurveyFiles& survey, const ObservationFiles& observation) {
  const TimeNs last = survey.entry(observation.pings.back()).time;
  std::size_t first = observation.pings.size() - 1;
  while (first > 0 && last - survey.entry(observation.pings[first - 1]).time <= kMinute) --first;
  const std::size_t intervals = observation.pings.size() - 1 - first;
  const double span_s = seconds(last - survey.entry(observation.pings[first]).time);
  return intervals > 0 && span_s > 0.0 ? 60.0 * static_cast<double>(intervals) / span_s : kNotKnown;
}

/// From the last that anybody said of it in these files to the newest datagram.
double age_s(const SurveyFiles& survey, const ObservationFiles& observation, NavQuantity quantity) {
  TimeNs newest = 0;
  TimeNs said = 0;
  for (const std::uint32_t f : observation.files) {
    const RawIndex& index = survey.files[f].index;
    newest = std::max(newest, index.last_datagram_time);
    for (const NavSeries& series : index.navigation) {
      if (series.quantity == quantity && !series.samples.empty()) said = std::max(said, series.samples.back().time);
    }
  }
  return said == 0 ? kNotKnown : seconds(newest - said);
}

std::string told(double value, const char* unit, int decimals = 1) {
  return std::isnan(value) ? "unknown" : fmt::format("{:.{}f}{}", value, decimals, unit);
}

}  // namespace

std::size_t newest_observation(const SurveyFiles& survey, const ObservationFiles* like) {
  std::size_t newest = 0;
  TimeNs last = std::numeric_limits<TimeNs>::min();
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    const ObservationFiles& one = survey.observations[i];
    const bool alike = like == nullptr || sounder_of(one.config) == sounder_of(like->config);
    const TimeNs time = survey.entry(one.pings.back()).time;
    if (!alike || time < last) continue;
    last = time;
    newest = i;
  }
  return newest;
}

LiveStatus live_status(const SurveyFiles& survey, double behind_s, const std::filesystem::path& out) {
  const ObservationFiles& observation = survey.observations[newest_observation(survey)];
  LiveStatus status;
  status.observation = observation.name;
  status.pings = std::ssize(observation.pings);
  status.newest = observation.navigation.back().time;
  status.pings_per_minute = rate(survey, observation);
  status.behind_s = behind_s;
  status.position_age_s = age_s(survey, observation, NavQuantity::position);
  status.heading_age_s = age_s(survey, observation, NavQuantity::heading);
  status.gps_minus_clock_s = observation.gps_minus_clock_s;
  std::int64_t channels = 0;
  for (const SurveyPing& part : survey.parts(observation.pings.back())) channels += survey.entry(part).channels;
  status.missing_channels = std::max<std::int64_t>(0, std::ssize(observation.config.beams) - channels);
  std::error_code unknown;
  std::filesystem::path there = std::filesystem::absolute(out, unknown);
  while (!std::filesystem::exists(there, unknown) && there.has_relative_path()) there = there.parent_path();
  const auto space = std::filesystem::space(there, unknown);
  status.disk_left_gb = unknown ? kNotKnown : static_cast<double>(space.available) / 1e9;
  return status;
}

std::string status_line(const LiveStatus& status) {
  return fmt::format(
      "{} ping {}, {} a minute, {} behind; position {} old, heading {} old, GPS minus clock {}; {} channels missing; "
      "{} left on disk",
      status.observation, status.pings - 1, told(status.pings_per_minute, ""), told(status.behind_s, " s"),
      told(status.position_age_s, " s"), told(status.heading_age_s, " s"), told(status.gps_minus_clock_s, " s", 2),
      status.missing_channels, told(status.disk_left_gb, " GB"));
}

}  // namespace sonar
