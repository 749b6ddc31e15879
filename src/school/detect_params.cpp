// SPDX-License-Identifier: Apache-2.0
#include "school/detect_params.h"

#include <algorithm>
#include <cmath>

namespace sonar {

double evidence_wanted(const DetectParams& params) {
  // A guess. Fading water without fish showed no school in any simulation; bubbles, plumes and single fish show more than
  // the rate says, and hardly depend on it.
  constexpr double kAtOne = 18.0;
  constexpr double kPerDecade = 2.0;
  return std::max(0.0, kAtOne - kPerDecade * std::log10(params.false_alarm));
}

double clear_evidence(const DetectParams& params) {
  constexpr double kSights = 3.0;
  return kChanceEvidence + evidence_wanted(params) / kSights;
}

}  // namespace sonar
