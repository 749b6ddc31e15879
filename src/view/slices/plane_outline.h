// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "view/maps/contours.h"
#include "view/slices/slice.h"

namespace sonar {

/// Where a place of the sonar frame lies to the sector's faces, m: the distance to the nearest one along arcs and the
/// ray; positive inside, 0 on a face, negative outside.
[[nodiscard]] double inside_by_m(const Sector& sector, const Point<Sonar>& p);

/// The edge of the sector in a plane slice, in pixels of the map. Open where the map ends first. Corners are cut by a
/// two hundredth of the map at most.
/// cost  a few ms
[[nodiscard]] std::vector<ContourLine> plane_outline(const SliceMap& map);

}  // namespace sonar
