// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "school/background.h"

namespace sonar {

/// What the water itself returns at each range, whatever the beam: reverberation, plankton, the tail of the ringing.
/// Schools fill some beams at a range, never most of them in all fans. Nothing of it changes what is no louder than
/// least.
/// sv      [fan][beam][sample], median-filtered Sv counts
/// flags   same shape; samples with kNeverMember say nothing
/// noise   of the beams: a sample that hardly stands above its own beam's noise shows quiet water
/// share   of the beams below it, 0..1; 0 = nothing is estimated
/// least   Sv counts: where the level comes out lower it is not looked at
/// out     [sample] Sv counts as filtered; kMinCount = lower than least, or too few beams are open there
/// threads pure
/// cost    0.2 ms for 20 x 25 x 1320 in quiet water
[[nodiscard]] std::vector<std::int16_t> reverberation_counts(View3<const std::int16_t> sv,
                                                             View3<const SampleFlags> flags, const Background& noise,
                                                             double share, int least);

}  // namespace sonar
