// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"

namespace sonar::bench {

// The rivals: ITK's medians over 3 x 3 x 23, on images of x = sample, y = beam, z = fan. Each call includes what a user
// pays for: making the filter, running it, its output image.

/// MedianImageFilter (quick-select in every window, borders replicated).
[[nodiscard]] Array3<std::int16_t> itk_median(View3<const std::int16_t> ping, int threads);

/// RankImageFilter with rank 0.5 (a moving histogram; its windows shrink at the borders).
[[nodiscard]] Array3<std::int16_t> itk_rank(View3<const std::int16_t> ping, int threads);

}  // namespace sonar::bench
