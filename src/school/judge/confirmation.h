// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// Unit of the evidence of a track's sights together.
inline constexpr std::string_view kAllSights = "evidence of all sights";

/// Judge `confirmation`: a school is seen in pings near each other, and what its sights show together is more than chance
/// gives. Faint sights count for little and many of them for much; a ping that shows none counts against it.
/// tracked  of one track, rising
/// pings    those that were tracked, rising
/// passage  evidence of each ping from before the first to behind the last, Passage
/// out      the figure is the most sights in a window, or the evidence of all
[[nodiscard]] std::optional<Reason> judge_confirmation(std::span<const TrackedDetection> tracked,
                                                       std::span<const DetectedPing> pings,
                                                       std::span<const double> passage, const TrackParams& params);

/// Where the ping of this index stands in the list.
[[nodiscard]] std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings,
                                                              std::int64_t ping_index);

}  // namespace sonar
