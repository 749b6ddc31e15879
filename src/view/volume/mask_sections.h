// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Two outlines that cross each other and so tell a mask's place and size from every side: that of the fan and that of the
/// beam that have most of its voxels, from each beam's (each fan's) nearest sample to its farthest.
/// out  closed lines, whose last place is their first; none of an empty mask
[[nodiscard]] std::vector<std::vector<Point<Sonar>>> mask_sections(const Sector& sector, const PingMask& mask);

}  // namespace sonar
