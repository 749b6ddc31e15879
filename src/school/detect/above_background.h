// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/detect/noise_level.h"

namespace sonar {

/// Where the filtered echo of a ping lies so far above its filtered background.
/// sv          [fan][beam][sample], median-filtered Sv counts
/// flags       same shape; kNeverMember samples are never above it
/// background  of the beams; rows without one are held against the water alone
/// water       what else is background; null = nothing
/// margin_db   above the background as filtered, > 0
/// out         sorted
/// threads     pure
/// cost        about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Run> above_background(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                                const Background& background, const WaterLevels* water,
                                                double margin_db);

}  // namespace sonar
