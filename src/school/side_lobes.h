// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/detect_params.h"

namespace sonar {

/// Whether a mask is what side lobes hear of the seabed or the surface: at its ranges most beams of its fans hear about
/// as much, for those two lie all around, and there is a much stronger echo of the seabed in other fans of the same
/// beams, or of the surface in fans close by, or the mask reaches the topmost fan below the surface, or the lowest above
/// the seabed. A school stands out in
/// its fans, or lies in the midst of the sector.
/// sv          [fan][beam][sample], median-filtered Sv counts
/// unfiltered  same shape
/// flags       same shape; seabed and surface are flagged
/// box         of the mask
/// cost        the box's fans and samples times all beams
[[nodiscard]] bool is_side_lobe(const PingMask& mask, const IndexBox& box, const Sector& sector,
                                View3<const std::int16_t> sv, View3<const std::int16_t> unfiltered,
                                View3<const SampleFlags> flags, const DetectParams& params);

}  // namespace sonar
