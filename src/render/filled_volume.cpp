// SPDX-License-Identifier: Apache-2.0
#include "render/filled_volume.h"

#include <algorithm>
#include <cstddef>

#include "base/units.h"
#include "view/slices/filled_sample.h"

namespace sonar {
FilledVolume filled_volume(const Array3<std::int16_t>& sv) {
  FilledVolume out{sv, {}};
  const auto all = sv.all();
  if (std::find(all.begin(), all.end(), kNoData) == all.end()) {
    return out;
  }
  const Shape3 shape = sv.shape();
  out.known = Array3<std::uint8_t>(shape, 1);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const auto row = sv.row(f, b);
      for (int s = 0; s < shape.samples; ++s) {
        if (row[static_cast<std::size_t>(s)] == kNoData) {
          out.known(f, b, s) = 0;
          out.sv(f, b, s) = filled_sample(sv, f, b, s);
        }
      }
    }
  }
  return out;
}

}  // namespace sonar
