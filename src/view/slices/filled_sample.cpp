// SPDX-License-Identifier: Apache-2.0
#include "view/slices/filled_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"

namespace sonar {

std::int16_t filled_sample(const Array3<std::int16_t>& sv, int fan, int beam, int sample) {
  if (const std::int16_t own = sv(fan, beam, sample); own != kNoData) return own;
  const Shape3 shape = sv.shape();
  const int first = std::max(sample - 1, 0);
  const int last = std::min(sample + 1, shape.samples - 1);
  int sum = 0;
  int count = 0;
  for (int f = std::max(fan - 1, 0); f <= std::min(fan + 1, shape.fans - 1); ++f) {
    for (int b = std::max(beam - 1, 0); b <= std::min(beam + 1, shape.beams - 1); ++b) {
      const auto row = sv.row(f, b);
      for (int s = first; s <= last; ++s) {
        const std::int16_t value = row[static_cast<std::size_t>(s)];
        sum += value != kNoData ? value : 0;
        count += value != kNoData ? 1 : 0;
      }
    }
  }
  return count > 0 ? static_cast<std::int16_t>(std::lround(static_cast<double>(sum) / count)) : kNoData;
}

}  // namespace sonar
