// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "school/background.h"
#include "school/detect_params.h"
#include "school/filtered_ping.h"
#include "school/runs.h"

namespace sonar {

/// Where the filtered echo of a ping stands so far above its filtered background.
/// sv          [fan][beam][sample], median-filtered Sv counts
/// flags       same shape; kNeverMember samples stand out nowhere
/// background  of the beams; rows without one stand out from the water alone
/// params      how the water's levels are found
/// margin_db   above the background as filtered, > 0
/// above       what is taken for the background
/// out         sorted
/// threads     pure
/// cost        about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Run> standing_out(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                            const Background& background, const DetectParams& params, double margin_db,
                                            Above above);

}  // namespace sonar
