// SPDX-License-Identifier: Apache-2.0
#include "school/detect_params.h"

#include <algorithm>
#include <cmath>

namespace sonar {

double evidence_wanted(const DetectParams& params) {
  // False schools an hour fall tenfold for each unit of evidence in simulated water without fish.
  constexpr double kAtOne = 8.0;
  constexpr double kPerDecade = 1.0;
  return std::max(kLeastEvidence, kAtOne - kPerDecade * std::log10(params.false_alarm));
}

}  // namespace sonar
