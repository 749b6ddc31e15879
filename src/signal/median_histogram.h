// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "signal/median_box.h"

namespace sonar {

/// Median of one row of a masked box by a histogram that slides along range (Huang 1979, two levels); any odd kernel.
/// in      masked: any margin; half_*: (kernel - 1) / 2
/// out     [sample]; kNoData where more than half of the kernel is left out
void median_row_histogram(const MaskedBox& masked, int fan, int beam, int half_fans, int half_beams, int half_samples,
                          std::span<std::int16_t> out);

}  // namespace sonar
