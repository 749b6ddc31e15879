// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/biomass/school_numbers.h"

namespace sonar::test {

/// Fish of 27 cm that echo as lines of a quarter of their length.
inline FishChoice line_fish() {
  FishChoice fish;
  fish.chosen.name = "line";
  fish.chosen.b_db = -68.0;
  fish.chosen.directivity = {0.25, 0.1, 0.0, 0.0};
  fish.lengths = {{{27.0, 1.0}}, 200.0};
  fish.weight = {0.005, 3.0};
  return fish;
}

}  // namespace sonar::test
