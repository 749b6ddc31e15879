// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "view/key_rows.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// A faded sample's colour.
[[nodiscard]] Rgba8 faded_colour(Rgba8 colour, const Theme& theme);
/// Whether a stripe of the hatch runs through a pixel.
[[nodiscard]] bool on_hatch(int x, int y, const Theme& theme);

/// Which masks have a voxel in the slice: [mask].
[[nodiscard]] std::vector<bool> cut_masks(const SliceMap& map, const std::vector<MaskLayer>& masks);

/// What the style's key has to explain, in order; none without a key, and for a slice that is plain and without schools.
/// cut  as cut_masks()
[[nodiscard]] std::vector<KeyEntry> slice_key(const SliceStyle& style, const std::vector<bool>& cut,
                                              const Theme& theme);

/// Of SliceData::shadow_from.
[[nodiscard]] KeyEntry shadow_key(const Theme& theme);

}  // namespace sonar
