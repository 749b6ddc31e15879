// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "school/seabed/seabed_echoes.h"

namespace sonar {

/// The seabed as one beam sees it.
struct SeabedHit {
  int row = 0;
  double range_m = 0.0;  ///< of the middle of the echo's strongest part
  Point<Sonar> place;    ///< there on the beam's axis
  double below_m = 0.0;  ///< the ping's plane, positive down
};

/// One hit for each beam with an echo that belongs to the seabed found: the one nearest to its plane. An echo that is cut
/// by the end of the record is none: its depth is but a bound.
/// water  that the seabed was found in
[[nodiscard]] std::vector<SeabedHit> seabed_hits(const Seabed& seabed, const SeabedWater& water);

/// Standard error of the depth of one hit, m: two thirds (68.27 %) of the ping's hits lie so near to its plane. What the seabed
/// has of relief is in it; what errs in all beams alike (sound speed, mounting angle, draught) is not. NaN of fewer than
/// min_inliers of SeabedParams.
[[nodiscard]] double depth_se_m(const std::vector<SeabedHit>& hits, const SeabedParams& params);

}  // namespace sonar
