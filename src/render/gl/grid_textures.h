// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/gl/fold_plan.h"
#include "render/gl/gl_object.h"
#include "render/gl/upload.h"
#include "render/grid_axes.h"
#include "render/macrocells.h"
#include "render/mask_grid.h"

namespace sonar {

/// Index over diamond angle: row 0 beams, row 1 fans; each entry with its rise to the next.
[[nodiscard]] Texture angle_texture(const GridAxes& axes);
/// Faces of the cells: row 0 (sine, cosine, beams a radian, 0) of each beam, row 1 (sine^2, 0, fans a radian, 0).
[[nodiscard]] Texture faces_texture(const GridAxes& axes);
/// r, g, b, extinction at the steps of `fine`.
[[nodiscard]] Texture optics_texture(const OpticalTable& table, const TransferTable& fine);

/// Values of cells, wrapped into rows of kCellRow.
inline constexpr int kCellRow = 4096;
/// Rows that so many cells take.
[[nodiscard]] int cell_rows(std::size_t cells);
/// Distance to the next cell that counts, and its flags (1 thin, 2 gaps, 4 masked).
[[nodiscard]] Texture state_texture(const std::vector<std::uint8_t>& distance, const std::vector<std::uint8_t>& flags);
[[nodiscard]] Texture means_texture(std::vector<std::array<float, 4>> means);
[[nodiscard]] Texture largest_texture(std::vector<std::int16_t> largest);

/// The folded volume as the shader's `sv_texture` wants it.
[[nodiscard]] Texture sv_texture(const FoldPlan& plan, View3<const std::int16_t> sv, Voxels voxels);
[[nodiscard]] Texture known_texture(const FoldPlan& plan, View3<const std::uint8_t> known);
[[nodiscard]] Texture mask_texture(const FoldPlan& plan, View3<const std::uint16_t> voxels);
[[nodiscard]] Texture mask_colours(const MaskGrid& masks);

}  // namespace sonar
