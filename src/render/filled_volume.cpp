// SPDX-License-Identifier: Apache-2.0
#include "render/filled_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"

namespace sonar {
namespace {

/// Mean of the known neighbours; kNoData where there is none.
std::int16_t mean_of_known(const Array3<std::int16_t>& sv, int fan, int beam, int sample) {
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

}  // namespace

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
          out.sv(f, b, s) = mean_of_known(sv, f, b, s);
        }
      }
    }
  }
  return out;
}

}  // namespace sonar
