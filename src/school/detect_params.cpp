// SPDX-License-Identifier: Apache-2.0
#include "school/detect_params.h"

#include "base/units.h"
#include "school/background.h"

namespace sonar {

DetectParams for_filter(const DetectParams& params, int rows) {
  DetectParams fitted = params;
  if (rows < params.peak_filter_rows) fitted.peak_percentile = 0.0;
  return fitted;
}

int least_background(const DetectParams& params) {
  return static_cast<int>(counts_from_db(params.floor_db - params.background_margin_db + kMedianOfMean_db));
}

}  // namespace sonar
