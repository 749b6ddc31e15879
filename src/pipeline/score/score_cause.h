// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "pipeline/score/score.h"
#include "pipeline/score/score_index.h"

namespace sonar {

/// Both sides of a comparison, borrowed.
struct ScoredSides {
  const Indexed& found;
  const ScoreSide& found_side;
  const Indexed& truth;
  const ScoreSide& truth_side;
};

/// What a false school is made of: the kind of company whose boxes hold most of its voxels over all its pings (a voxel
/// in several boxes of a kind counts once), and which share they hold. Among kinds that hold as many it is the one
/// whose boxes are smallest together, as the water's surface may fill a fan in which a plume hangs. kCauseNone where
/// the share is below kCauseShare; kCauseUnknown and NaN where the truth does not tell company.
[[nodiscard]] std::pair<std::string, double> cause_of(const SchoolKey& track, const ScoredSides& sides);

}  // namespace sonar
