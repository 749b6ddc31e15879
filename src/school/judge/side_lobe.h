// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// Judge `side_lobe`: what a loud school returns through the side lobes of beams that point elsewhere lies at its own range,
/// in whatever direction, and comes and goes with it. A sight counts as that where another detection of its ping, louder
/// by more than side lobes take away, spans the range of its middle.
/// tracked  of one track, rising
/// pings    those that were tracked, rising
/// out      the figure is by how much the other one is louder, median over such sights
[[nodiscard]] std::optional<Reason> judge_side_lobe(std::span<const TrackedDetection> tracked,
                                                    std::span<const DetectedPing> pings);

}  // namespace sonar
