// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "school/detect/noise_level.h"

namespace sonar {

/// Samples of a block, which is about as long as the shortest school.
[[nodiscard]] int block_samples(const RangeAxis& range);

/// Mean sv of blocks of each beam: what the water's levels are told from.
/// sv       [fan][beam][sample], unfiltered Sv counts
/// flags    same shape, seabed included; kNotFiltered samples are left out
/// samples  of each block
/// out      [fan][beam][block] Sv counts; kNoData where less than half of a block is sound
[[nodiscard]] Array3<std::int16_t> block_means(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                               int samples);

/// Mean noise of each beam in the middle of each block.
/// blocks  shape of block_means()
/// out     Sv counts; kMinCount = not known
[[nodiscard]] Array3<std::int16_t> block_noise(const Background& noise, const Shape3& blocks, int samples);

}  // namespace sonar
