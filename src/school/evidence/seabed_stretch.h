// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "geo/sector.h"
#include "school/evidence/null_model.h"

namespace sonar {

/// By how much each beam's range is stretched, so that all beams of a fan, of all pings of a window, meet the seabed at the
/// same one: beams hear its beam-edge echo at like shares of their way to it.
/// out  [ping][row]; empty for pings, or 1 for fans, in which no seabed is met
[[nodiscard]] std::vector<std::vector<float>> seabed_stretch(std::span<const WaterPing> window, const Sector& sector);

/// By how much nearer hills may bring the seabed of a window: the share of its depth that is left above the level that
/// few of them reach. 1 = none was found.
[[nodiscard]] double seabed_nearer(std::span<const WaterPing> window);

}  // namespace sonar
