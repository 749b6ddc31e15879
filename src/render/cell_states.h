// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/work.h"
#include "render/grid_axes.h"
#include "render/homogeneous_cells.h"
#include "render/mask_grid.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// What of the cells depends on the view.
struct CellQuestion {
  RayMode mode = RayMode::accumulate;
  double first_hit_db = 0.0;
  bool data = true;
  double thin_limit = 0.0;  ///< 0 = no cell is thin
  friend bool operator==(const CellQuestion&, const CellQuestion&) = default;
};
/// A mean knows no gradient: under light no cell is thin.
[[nodiscard]] CellQuestion cell_question(const VolumeView& view, const DrawQuality& quality);

inline constexpr int kCellThin = 1, kCellGaps = 2, kCellMasked = 4;

/// What a ray does in each cell.
struct CellStates {
  std::vector<std::uint8_t> distance;       ///< to the next cell that counts
  std::vector<std::uint8_t> flags;          ///< kCellThin and its like
  std::vector<std::array<float, 4>> means;  ///< empty where no cell is thin
};
[[nodiscard]] CellStates cell_states(const CellQuestion& question, const FilledVolume& volume, const Macrocells& cells,
                                     const TransferTable& table, const MaskGrid& masks, double spacing_m, Work& work);

}  // namespace sonar
