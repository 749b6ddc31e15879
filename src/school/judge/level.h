// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// Judge `level`: a school holds several fish in each volume that the sonar tells apart, everywhere in it. Where its members,
/// taken together, are fainter than a single small fish in such a volume, it is plankton, bubbles that linger, or a few
/// fish far from each other, however clearly it stands out of quiet water.
/// tracked  of one track, rising
/// pings    those that were tracked, rising
/// out      the figure is its reference, median over its sights
[[nodiscard]] std::optional<Reason> judge_level(std::span<const TrackedDetection> tracked,
                                                std::span<const DetectedPing> pings, const TrackParams& params);

}  // namespace sonar
