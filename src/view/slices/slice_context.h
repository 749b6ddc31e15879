// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/slices/slice_picture.h"

namespace sonar {

/// What lies over a slice's data: outline of the sector, range rings, bearings, sea surface, ship, north arrow.
/// corner  upper left pixel of the map in the picture
void add_slice_context(FrameDescription& frame, const SliceMap& map, PixelPoint corner, const SlicePing& ping,
                       const SliceStyle& style, const Theme& theme);

/// One line on where the slice lies, and what the bearings along its edge start from: "Top: fan 7, elevation -13.5 deg,
/// 85.2 kHz; bearings from the bow".
[[nodiscard]] std::string slice_text(const Sector& sector, const SliceView& view, const SlicePing& ping,
                                     const SliceStyle& style, const Units& units = {});

}  // namespace sonar
