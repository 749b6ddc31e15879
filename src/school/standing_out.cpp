// SPDX-License-Identifier: Apache-2.0
#include "school/standing_out.h"

#include <utility>

#include "base/units.h"
#include "school/candidates.h"
#include "school/detect.h"

namespace sonar {

std::vector<Run> standing_out(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                              const Background& background, const DetectParams& params, double margin_db, Above above) {
  WaterLevels water = water_levels(sv, flags, background, params);
  if (above == Above::noise) water.reverberation.clear();
  const double lowest_db = db_from_counts(kMinCount);
  return Thresholder(sv, flags, background, std::move(water), nullptr)
      .candidates(lowest_db, margin_db + kMedianOfMean_db);
}

}  // namespace sonar
