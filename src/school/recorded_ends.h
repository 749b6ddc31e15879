// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"

namespace sonar {

/// One past the last sample that any beam of a fan recorded, for each fan: behind it there is nothing that a mask could
/// hold, where a lost beam between recorded ones is a gap in the water. Fans may be recorded to different ranges; one
/// without any sample counts as recorded as far as the others.
/// flags   [fan][beam][sample]
/// out     [fan]
/// cost    one look at each beam's tail
[[nodiscard]] std::vector<int> recorded_ends(View3<const SampleFlags> flags);

}  // namespace sonar
