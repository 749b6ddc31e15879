// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "model/mask.h"
#include "model/water_levels.h"

namespace sonar {

/// The samples of the blocks above the background, as sorted runs within the recorded samples.
[[nodiscard]] std::vector<Run> seed_runs(const WaterLevels& water, const Shape3& shape);

/// The most evidence of a block that holds a voxel of a mask; 0 where none does.
[[nodiscard]] double evidence_of(const PingMask& mask, const WaterLevels& water);

}  // namespace sonar
