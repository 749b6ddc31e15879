// SPDX-License-Identifier: Apache-2.0
#include "geo/shells.h"

#include <algorithm>
#include <cstddef>

namespace sonar {

std::vector<double> shells_m3_per_sr(const RangeAxis& range) {
  std::vector<double> out(static_cast<std::size_t>(std::max(0, range.count)), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double r = range.range_m(static_cast<double>(i));
    if (r < range.spacing_m) continue;
    const double near_m = r - range.spacing_m / 2;
    const double far_m = r + range.spacing_m / 2;
    out[i] = (far_m * far_m * far_m - near_m * near_m * near_m) / 3.0;
  }
  return out;
}

}  // namespace sonar
