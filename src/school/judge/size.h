// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "school/detect_params.h"
#include "school/detection.h"
#include "school/judge/ping_echo.h"
#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// Judge `size`: single fish, impulses and other sounders' pulses fill one beam, or are shorter along range than a
/// school. The figure is the first extent that is too small.
[[nodiscard]] std::optional<Reason> judge_size(const PingEcho& echo, const Detection& detection,
                                               const DetectParams& params);

/// The same of a school by what is left of its masks: median extents over its sights.
/// tracked  of one track, rising
/// pings    those that were tracked, rising
[[nodiscard]] std::optional<Reason> judge_size(std::span<const TrackedDetection> tracked,
                                               std::span<const DetectedPing> pings, const Sector& sector,
                                               const DetectParams& params);

}  // namespace sonar
