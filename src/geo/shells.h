// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/sector.h"

namespace sonar {

/// [sample] (r2^3 - r1^3)/3 between half a spacing before and behind: the volume of a sample's shell in one steradian, m3.
/// 0 where the range is below one spacing.
[[nodiscard]] std::vector<double> shells_m3_per_sr(const RangeAxis& range);

}  // namespace sonar
