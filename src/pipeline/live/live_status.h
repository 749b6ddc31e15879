// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/time.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// How the recording goes, by its newest ping: what an operator looks at before anything is found. NaN = not known.
struct LiveStatus {
  std::string observation;        ///< that the ping belongs to
  std::int64_t pings = 0;         ///< of that observation
  TimeNs newest = 0;              ///< time of the ping
  double pings_per_minute = 0.0;  ///< over the last minute of data
  double behind_s = 0.0;  ///< from when the newest ping can have been written at the earliest, until it was worked out
  double position_age_s = 0.0;  ///< from the last sentence to the newest datagram
  double heading_age_s = 0.0;
  double gps_minus_clock_s = 0.0;
  std::int64_t missing_channels = 0;  ///< that the newest ping lacks
  double disk_left_gb = 0.0;          ///< where products are written, 10^9 bytes
};

/// The observation whose last ping is the newest.
/// survey  with at least one ping
/// like    only those of its sounder; null = of any
[[nodiscard]] std::size_t newest_observation(const SurveyFiles& survey, const ObservationFiles* like = nullptr);

/// survey  with at least one ping
/// out     folder of the products
[[nodiscard]] LiveStatus live_status(const SurveyFiles& survey, double behind_s, const std::filesystem::path& out);

/// For people, in one line: "obs-0002 ping 311, 20.1 a minute, 0.2 s behind, position 0.8 s old, ...".
[[nodiscard]] std::string status_line(const LiveStatus& status);

}  // namespace sonar
