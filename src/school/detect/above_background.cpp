// SPDX-License-Identifier: Apache-2.0
#include "school/detect/above_background.h"

#include "school/detect/thresholder.h"

namespace sonar {

std::vector<Run> above_background(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                  const Background& background, const WaterLevels* water, double margin_db) {
  return Thresholder(sv, flags, background, water, nullptr).above_background(margin_db);
}

}  // namespace sonar
