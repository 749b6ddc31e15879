// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/detect/background.h"

namespace sonar {

/// Where the filtered echo of a ping stands so far above its filtered background.
/// sv          [fan][beam][sample], median-filtered Sv counts
/// flags       same shape; kNeverMember samples stand out nowhere
/// background  of the beams; rows without one stand out from the water alone
/// water       what else is background; null = nothing
/// margin_db   above the background as filtered, > 0
/// out         sorted
/// threads     pure
/// cost        about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Run> standing_out(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                            const Background& background, const WaterLevels* water, double margin_db);

}  // namespace sonar
