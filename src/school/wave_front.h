// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geo/sector.h"
#include "model/mask.h"
#include "school/detect_params.h"

namespace sonar {

/// Whether a mask is another sonar's pulse, or noise that sets in within a ping: all its beams hear that at one time, so
/// that it lies at one range however wide it is. A body so wide is nowhere as near to a sphere round the sonar, and its
/// edges are ragged. Looked at are the middles of what each beam holds, where there are enough fans or beams side by
/// side that no beam pattern smears one small body over them, and both edges, whatever the shape.
/// box   of the mask
/// cost  linear in runs
[[nodiscard]] bool is_wave_front(const PingMask& mask, const IndexBox& box, const Sector& sector,
                                 const DetectParams& params);

}  // namespace sonar
