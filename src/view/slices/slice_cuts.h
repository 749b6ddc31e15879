// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "model/mask.h"
#include "view/slices/slice.h"

namespace sonar {

// Where slices meet other things: masks, and each other.

/// The farthest voxel of a run that a slice shows; empty where the slice passes the run by. A plane meets a voxel where
/// its cell has corners on both sides.
[[nodiscard]] std::optional<Voxel> farthest_cut(const Sector& sector, const Slice& slice, const Run& run);
/// Whether a slice shows any voxel of a mask.
[[nodiscard]] bool cuts(const Sector& sector, const Slice& slice, const PingMask& mask);

/// Where another slice runs through a slice's picture, as far as the sector reaches: lines in pixels of the map, none
/// where they do not meet. Within a quarter of a pixel where the line is straight, and about one where it bends.
/// cost  below a millisecond
[[nodiscard]] std::vector<std::vector<PixelPoint>> slice_cut(const SliceMap& map, const Slice& other);

}  // namespace sonar
