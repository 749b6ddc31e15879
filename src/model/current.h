// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "base/time.h"
#include "geo/frames.h"

namespace sonar {

/// Water velocity over ground at one depth.
struct CurrentAt {
  double depth_m = 0.0;
  double east_mps = 0.0;
  double north_mps = 0.0;
  friend bool operator==(const CurrentAt&, const CurrentAt&) = default;
};

/// What an acoustic Doppler current profiler (ADCP) tells of one time and place.
struct CurrentProfile {
  TimeNs time = 0;
  Geographic place{std::numeric_limits<double>::quiet_NaN(),
                   std::numeric_limits<double>::quiet_NaN()};  ///< NaN = unknown
  std::vector<CurrentAt> bins;                                 ///< by rising depth; only what is known
};
using CurrentProfiles = std::vector<CurrentProfile>;  ///< by rising time

/// The velocity at a depth of one profile, linear between its bins, the first and the last holding beyond; empty where
/// the nearest bin is farther than max_gap_m.
[[nodiscard]] std::optional<CurrentAt> current_in(const CurrentProfile& profile, double depth_m, double max_gap_m);

/// Slower water has no direction.
inline constexpr double kLeastCurrent_mps = 0.005;

/// The speed of the longest arrows: the fastest, but no more than half as much again as nine tenths of the speeds keep below,
/// so that a few wild bins (of an ADCP mostly near the bottom and the surface) do not make all others too short to be read.
/// Where both components of the velocity vary normally, one speed in 180 is above that and is drawn cut. Of fewer than ten
/// speeds none is.
/// speeds_mps  0 or more, in any order
/// out         0 without any
[[nodiscard]] double longest_arrow_mps(std::vector<double> speeds_mps);

}  // namespace sonar
