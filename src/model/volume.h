// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"

namespace sonar {

/// One ping on its grid. Counts of 10 log10(2)/256 dB: power (dB re 1 W) before calibration, Sv (dB re 1 m^-1) after.
/// Every row has the same length; where a channel recorded less, the rest is kNoData and flagged as dropout.
struct Volume {
  Array3<std::int16_t> counts;  ///< [fan][beam][sample]; kNoData = -32768
  Array3<SampleFlags> flags;    ///< same shape
};

}  // namespace sonar
