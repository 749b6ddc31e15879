// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"

namespace sonar {

/// A volume that can be interpolated across gaps. How "no data" is drawn, by every back-end: a missing sample is
/// filled_sample(), the mean of its known neighbours, and extinction is multiplied by the interpolated share of known
/// samples, so that it fades to nothing over one cell. First hit and maximum take places with a share of at least one
/// half.
struct FilledVolume {
  Array3<std::int16_t> sv;     ///< [fan][beam][sample]; still kNoData where no neighbour is known
  Array3<std::uint8_t> known;  ///< [fan][beam][sample] 1 or 0; empty where everything is known
  [[nodiscard]] bool complete() const { return known.all().empty(); }
};

[[nodiscard]] FilledVolume filled_volume(const Array3<std::int16_t>& sv);

}  // namespace sonar
