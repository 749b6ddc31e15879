// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geo/sector.h"
#include "view/image.h"
#include "view/slices/slice.h"

namespace sonar {

/// SliceGeometry::voxel() of the centre of every pixel, exactly, without its trigonometry for most of them: a pixel is
/// first tried in its left neighbour's fan and beam, by cross products with their borders, and only a pixel within
/// 1e-9 rad of a border, or in another cell, has its angles worked out.
/// extent  spread over all pixels
/// return  [height][width], (fan * beams + beam) * samples + sample; -1 = nothing
/// cost    about 10 ns a pixel
[[nodiscard]] std::vector<std::int32_t> slice_voxels(const Sector& sector, const SliceView& view,
                                                     const SliceExtent& extent, PixelSize size);

}  // namespace sonar
