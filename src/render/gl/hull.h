// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "render/grid_axes.h"

namespace sonar {

/// The closed surface of the sector (outer sphere, two planes, two cones) as triangles in the fan frame, metres; each
/// piece as flat as it comes lies outside the true surface or on it, so that no pixel of the sector is missed.
[[nodiscard]] std::vector<std::array<float, 3>> sector_hull(const GridAxes& axes);

}  // namespace sonar
