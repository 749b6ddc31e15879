// SPDX-License-Identifier: Apache-2.0
#include "school/recorded_ends.h"

#include <algorithm>
#include <cstddef>

namespace sonar {

std::vector<int> recorded_ends(View3<const SampleFlags> flags) {
  const Shape3 shape = flags.shape();
  std::vector<int> ends(static_cast<std::size_t>(shape.fans), 0);
  for (int fan = 0; fan < shape.fans; ++fan) {
    int& end = ends[static_cast<std::size_t>(fan)];
    for (int beam = 0; beam < shape.beams; ++beam) {
      const auto row = flags.row(fan, beam);
      int own = shape.samples;
      while (own > end && any(row[static_cast<std::size_t>(own - 1)] & SampleFlags::dropout)) --own;
      end = std::max(end, own);
    }
  }
  const int longest = ends.empty() ? 0 : *std::max_element(ends.begin(), ends.end());
  std::replace(ends.begin(), ends.end(), 0, longest > 0 ? longest : shape.samples);
  return ends;
}

}  // namespace sonar
