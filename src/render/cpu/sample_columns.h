// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"

namespace sonar {

/// A volume so that the four samples of one range round a place between beams and fans lie together, and those of the
/// next range behind them: [fan cell][beam cell][sample][column], columns (fan, beam) 00, 01, 10, 11. Four times the
/// memory; a sample of a ray is one load of 16 bytes.
/// sv  2 fans, beams and samples at least
void lay_columns(const Array3<std::int16_t>& sv, std::vector<std::int16_t>& out);

}  // namespace sonar
