// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "school/judge/judge_params.h"
#include "school/judge/track_echo.h"

namespace sonar {

/// Judge `level`: a school holds several fish in each volume that the sonar tells apart, everywhere in it. Where its members,
/// taken together, are fainter than a single small fish in such a volume, it is plankton, bubbles that linger, or a few
/// fish far from each other, however clearly it lies above the background of quiet water.
/// out  the figure is its reference, median over its sightings
[[nodiscard]] std::optional<Reason> judge_level(const TrackEcho& track, const LevelParams& params);

}  // namespace sonar
