// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/detect_params.h"
#include "school/seabed.h"

namespace sonar {

/// Whether a mask grows louder towards the seabed's margin, as the flank of the seabed's own echo does: a school at the
/// seabed is brightest inside itself.
/// sv      [fan][beam][sample], median-filtered Sv counts
/// flags   same shape; the seabed is flagged
/// freed   [row] Seabed::open: there it is known to be no flank
[[nodiscard]] bool rises_to_seabed(const PingMask& mask, View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                   const DetectParams& params, std::span<const Stretch> freed = {});

/// A mask without the beams in which it does, where at least min_free_share of it is left: a school a little above the
/// seabed hangs together with the flank of the seabed's echo in the beams below it. Else the mask as it is.
[[nodiscard]] PingMask free_of_seabed(PingMask mask, View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                      const DetectParams& params, std::span<const Stretch> freed = {});

}  // namespace sonar
