// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "render/macrocells.h"
#include "view/volume/volume_scene.h"

namespace sonar {

inline constexpr int kMostMasks = 255;

/// All masks of a ping on its grid. A voxel of two schools belongs to the one with the larger confidence there,
/// the first of equal ones.
struct MaskGrid {
  Array3<std::uint16_t> voxels;           ///< [fan][beam][sample] layer << 8 | confidence; layer 1.., 0 = none
  std::vector<std::array<float, 3>> rgb;  ///< [layer - 1]
  std::vector<std::uint8_t> cells;        ///< [cell] 1 where a cell (its faces included) touches a mask
  [[nodiscard]] bool empty() const { return rgb.empty(); }
};

/// errors  bad_parameter: a run outside the grid, runs and confidences of different number, over 255 masks, no mask
[[nodiscard]] Result<MaskGrid> mask_grid(std::span<const MaskLayer> masks, const Macrocells& cells, Shape3 shape);

}  // namespace sonar
