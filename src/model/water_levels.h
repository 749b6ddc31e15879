// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sonar {

/// What a ping's water shows where there is no school, beside the mean noise of each beam. Only the whole ping tells.
struct WaterLevels {
  /// [sample] what most beams return at that range, Sv counts as filtered; kMinCount, or beyond the end = nothing loud
  std::vector<std::int16_t> reverberation;
  /// Up to here above a beam's mean noise fluctuates the filtered noise alone, counts; kMinCount = not known
  std::int16_t noise_reach = kMinCount;
  friend bool operator==(const WaterLevels&, const WaterLevels&) = default;
};

}  // namespace sonar
