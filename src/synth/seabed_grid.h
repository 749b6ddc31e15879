// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/depth_grid.h"
#include "synth/scene.h"

namespace sonar::synth {

/// The seabed of a survey as a grid of depths: each observation's own terrain as far as its beams reach (and two steps of
/// the grid more), so that what the sonar sees and what a map shows agree to the grid's interpolation; between and
/// beyond them made up, without a jump.
[[nodiscard]] DepthGrid seabed_grid(const std::vector<Scene>& scenes);

}  // namespace sonar::synth
