// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/beam_grid.h"

namespace sonar {

/// Between an angle of a rising list and its neighbour; 1 where it is alone.
[[nodiscard]] double spacing_deg(const std::vector<double>& angles, int at);

/// How many neighbouring voxels fade as one: within the two-way beam over fans and beams, and within the pulse along range.
/// So many times as large as of independent voxels is the variance of a sum over them.
/// sample_m  spacing of the samples
/// pulse_m   extent of the pulse along range, c tau / 2
/// row       fan * beams + beam
[[nodiscard]] double voxels_alike(const BeamGrid& grid, double sample_m, double pulse_m, int row);
/// The same each way; voxels_alike() is their product.
struct VoxelsAlike {
  double fans = 1.0;
  double beams = 1.0;
  double samples = 1.0;
};
[[nodiscard]] VoxelsAlike voxels_alike_each_way(const BeamGrid& grid, double sample_m, double pulse_m, int row);

}  // namespace sonar
