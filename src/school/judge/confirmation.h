// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// Judge `confirmation`: pings near each other show a school clearly; fainter sights only carry it on. What one ping alone
/// shows is another sounder's pulse, or chance.
/// tracked  of one track, rising
/// pings    those that were tracked, rising
/// out      the figure is the most clear sights in a window
[[nodiscard]] std::optional<Reason> judge_confirmation(std::span<const TrackedDetection> tracked,
                                                       std::span<const DetectedPing> pings, const TrackParams& params);

/// Where the ping of this index stands in the list.
[[nodiscard]] std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings,
                                                              std::int64_t ping_index);

}  // namespace sonar
