// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "model/mask.h"
#include "school/runs.h"

namespace sonar {

/// Shares water among schools that meet in it: from each school's core it is flooded, the loudest voxels first, so that
/// the floods meet along the saddles between them.
/// sv      [fan][beam][sample] counts
/// water   sorted runs
/// cores  [school] sorted runs within the water; no voxel in two
/// out     [school] sorted runs, the cores included; what no flood reaches is in none
/// source  watershed by a priority queue (Meyer 1991)
[[nodiscard]] std::vector<std::vector<Run>> flood(View3<const std::int16_t> sv, std::span<const Run> water,
                                                  std::span<const std::vector<Run>> cores, Connectivity connectivity);

}  // namespace sonar
