// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geo/frames.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// How the echo is spread over the members that are heard, background taken off, weighted by volume. All are unknown
/// where the mean is not above the background. Fading alone gives sv a coefficient of variation of 1, a skewness of 2
/// and a kurtosis of 6: what lies above is the school's.
struct EchoSpread {
  double robust_mean_db =
      kUnknown;                 ///< between the 5th and the 95th percentile, over what these leave of Rayleigh fading
  double variation = kUnknown;  ///< standard deviation of sv over its mean
  double skewness = kUnknown;   ///< third central moment over the standard deviation cubed
  double kurtosis = kUnknown;   ///< fourth over its fourth power, less 3: 0 = as of a normal distribution
  double core_edge_db = kUnknown;      ///< mean Sv of the core less that of the other members
  std::optional<Point<Sonar>> centre;  ///< of mass: places weighted by sv times volume
};

/// core   members of it are the core; sorted, apart
/// cost   linear in the mask's voxels
[[nodiscard]] EchoSpread echo_spread(const MeasureInput& ping, const PingMask& mask, const std::vector<Run>& core);

}  // namespace sonar
