// SPDX-License-Identifier: Apache-2.0
#include "model/mask_middle.h"

#include <cmath>

namespace sonar {

std::optional<MaskMiddle> mask_middle(const PingMask& mask, int beams) {
  if (mask.empty()) return std::nullopt;
  double fan = 0.0;
  double beam = 0.0;
  double sample = 0.0;
  double count = 0.0;
  for (const Run& run : mask.runs) {
    const int fan_of_row = run.row / beams;
    const int beam_of_row = run.row % beams;
    fan += 1.0 * fan_of_row * run.count;
    beam += 1.0 * beam_of_row * run.count;
    sample += (run.first_sample + 0.5 * (run.count - 1)) * run.count;
    count += run.count;
  }
  const auto nearest = [count](double sum) { return static_cast<int>(std::lround(sum / count)); };
  return MaskMiddle{nearest(fan), nearest(beam), nearest(sample)};
}

}  // namespace sonar
