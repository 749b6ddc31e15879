// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "base/work.h"
#include "render/grid_axes.h"
#include "render/macrocells.h"

namespace sonar {

/// Mean extinction x (r, g, b) and mean extinction of each cell, over values interpolated at 2 x 2 x 2 Gauss points of
/// every voxel cell (means over the samples themselves would be too bright: speckle).
/// candidates  [cell] cells to be worked out; the others are 0
[[nodiscard]] std::vector<std::array<float, 4>> cell_means(const FilledVolume& volume, const Macrocells& cells,
                                                           const TransferTable& table,
                                                           const std::vector<std::uint8_t>& candidates, Work& work);

/// Cells among `visible` so thin that one segment will do: largest extinction x 16 samples x spacing <= limit.
[[nodiscard]] std::vector<std::uint8_t> thin_cells(const Macrocells& cells, const TransferTable& table,
                                                   const std::vector<std::uint8_t>& visible, double spacing_m,
                                                   double limit);

}  // namespace sonar
