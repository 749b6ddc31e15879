// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geo/sector.h"
#include "school/judge/ping_echo.h"
#include "school/track.h"

namespace sonar {

/// What the pings of a track's passage show where its school is or must be: a place that is known beforehand needs less
/// evidence than one that is sought all over the water.
/// school    of these pings
/// pings     those that were tracked, rising
/// velocity  of the school over ground, m/s
/// out       by ping, without gaps: from some pings before the first sight to some behind the last, as long as the
///           school lies inside the sector; the most evidence where its mask has moved to, 0 below kChanceEvidence
struct Passage {
  std::size_t first = 0;  ///< position in `pings`
  std::vector<double> evidence;
};
[[nodiscard]] Passage look_again(std::span<const TrackedDetection> school, std::span<const DetectedPing> pings,
                                 const Sector& sector, const Point<Enu>& velocity_mps);

/// Where a school must be in a ping that shows something there, and in which it was not detected.
struct ExpectedSight {
  std::size_t ping = 0;       ///< position in the list of pings
  PingMask place;             ///< its mask of the nearest sight, moved; without confidence
  double reference_db = 0.0;  ///< of that sight
  double threshold_db = 0.0;
  double evidence = 0.0;
};

/// Between the sights of a school, and before and behind them as long as each ping shows something.
[[nodiscard]] std::vector<ExpectedSight> expected_sights(const SchoolTrack& school, std::span<const DetectedPing> pings,
                                                         const Sector& sector);

/// What lies above the school's threshold and the water where it is expected.
/// taken  voxels of other schools
[[nodiscard]] std::optional<Detection> detect_expected(const PingEcho& echo, const ExpectedSight& expected,
                                                       const PingMask& taken, const DetectParams& params);

}  // namespace sonar
