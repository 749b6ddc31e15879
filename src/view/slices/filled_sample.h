// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"

namespace sonar {

/// A sample as it is interpolated: where it is missing, the mean of its known neighbours (of 26, in dB), so that no level
/// between "nothing" and the data is invented at the rim; kNoData where none of them is known either.
/// sv     [fan][beam][sample] counts, kNoData where missing
[[nodiscard]] std::int16_t filled_sample(const Array3<std::int16_t>& sv, int fan, int beam, int sample);

}  // namespace sonar
