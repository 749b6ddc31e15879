// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/background.h"
#include "school/detect_params.h"
#include "school/seabed.h"

namespace sonar {

/// Whether a mask is the seabed's nearest point, which side lobes hear whatever the beam: it lies within that range and
/// not much more, and so far off its fans become louder as a whole. Seen where the sector itself ends far above that
/// point. A school reaches beyond, or stands out of its fans clearly.
/// sv      [fan][beam][sample], median-filtered Sv counts
/// flags   same shape; kNeverMember samples say nothing
/// noise   of the beams: only what is louder is heard
/// params  ring_*, side_lobe_known_share
/// cost    the ring's samples times the beams of the mask's fans
[[nodiscard]] bool is_nadir_ring(const PingMask& mask, const IndexBox& box, const Seabed& seabed, const Sector& sector,
                                 View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& noise,
                                 const DetectParams& params);

}  // namespace sonar
