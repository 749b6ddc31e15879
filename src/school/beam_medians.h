// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/sample_flags.h"

namespace sonar {

/// Running median along one beam of the samples that are no faults.
/// sv       unfiltered Sv counts of the beam
/// flags    of the same samples
/// filtered stands in where less than half of the window is sound
/// first, end  of the wanted samples
/// half     samples on either side, >= 0
/// out      [end - first] counts
void beam_medians(std::span<const std::int16_t> sv, std::span<const SampleFlags> flags,
                  std::span<const std::int16_t> filtered, int first, int end, int half, std::vector<std::int16_t>& out);

}  // namespace sonar
