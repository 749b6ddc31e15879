// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/short_means.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/check.h"
#include "base/units.h"

namespace sonar {

Array3<float> short_means(View3<const std::int16_t> sv, View3<const SampleFlags> flags, int samples) {
  SONAR_CHECK(sv.shape() == flags.shape() && samples > 0);
  const Shape3 shape = sv.shape();
  const int pieces = (shape.samples + samples - 1) / samples;
  Array3<float> means({shape.fans, shape.beams, pieces}, std::numeric_limits<float>::quiet_NaN());
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const std::int16_t* counts = sv.row(row).data();
    const SampleFlags* flag = flags.row(row).data();
    const auto out = means.view().row(row);
    for (int piece = 0; piece < pieces; ++piece) {
      const int end = std::min(shape.samples, (piece + 1) * samples);
      double sum = 0.0;
      int sound = 0;
      for (int s = piece * samples; s < end; ++s) {
        if (counts[s] == kNoData || any(flag[s] & kNotFiltered)) continue;
        sum += linear_from_count(counts[s]);
        ++sound;
      }
      if (2 * sound >= samples) out[static_cast<std::size_t>(piece)] = static_cast<float>(sum / sound);
    }
  }
  return means;
}

}  // namespace sonar
