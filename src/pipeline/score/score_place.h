// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/beam_grid.h"
#include "model/mask.h"
#include "pipeline/score/score.h"

namespace sonar {

/// Median of what is finite; NaN of nothing.
[[nodiscard]] double median_known(std::vector<double> values);

/// Mean elevation of a mask's voxels, each counting once, degrees, positive up; NaN of an empty one.
/// mask            runs by channel
/// row_of_channel  [channel] -> row of the grid
[[nodiscard]] double mean_elevation_deg(const PingMask& mask, const BeamGrid& grid,
                                        const std::vector<int>& row_of_channel);

/// What the beams of all observations reach together, half a spacing beyond the outermost fans; ranges from 0.
[[nodiscard]] ScoreSpan span_of(const ScoreSide& truth);

}  // namespace sonar
