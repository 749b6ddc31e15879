// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/frames.h"
#include "model/school.h"

namespace sonar {

/// Where a school's centre was, in the pings that see it uncut.
struct CentreTrack {
  Geographic origin;      ///< of east and north: the first place
  std::vector<double> t;  ///< s, from the first
  std::vector<double> east;
  std::vector<double> north;
  std::vector<double> down;  ///< depth, m
  std::vector<std::int64_t> ping_index;

  /// Whether it is long enough for a speed.
  [[nodiscard]] bool tells_speed(int min_pings, double min_span_s) const;
};

/// rows  of one school, rising time
[[nodiscard]] CentreTrack centre_track(std::span<const SchoolPingRow> rows);

}  // namespace sonar
