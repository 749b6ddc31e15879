// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"

namespace sonar {

/// Mean sv of short pieces of each beam: what the water's levels are told from.
/// sv       [fan][beam][sample], unfiltered Sv counts
/// flags    same shape, seabed included; kNotFiltered samples are left out
/// samples  of each piece
/// out      [fan][beam][piece], linear, m^-1; NaN where less than half of the piece is sound
[[nodiscard]] Array3<float> short_means(View3<const std::int16_t> sv, View3<const SampleFlags> flags, int samples);

}  // namespace sonar
