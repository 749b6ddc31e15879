// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "geo/sector.h"
#include "school/track.h"

namespace sonar {

/// A school's masks of neighbouring pings show the same fish. What a mask holds and the others, looked at where the school
/// swam to, hardly ever do is water that one ping's fading let in, or a neighbour that was touched then.
/// Puts what is left of each mask into its sight as `part`; sights with fewer than two near them stay as they are.
/// school  of these pings
/// pings   those that were tracked, rising
void steady_masks(SchoolTrack& school, std::span<const DetectedPing> pings, const Sector& sector);

}  // namespace sonar
