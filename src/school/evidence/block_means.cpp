// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/block_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/check.h"
#include "base/units.h"

namespace sonar {
namespace {

constexpr double kBlock_m = 5.5;

std::int16_t within_counts(double counts) {
  return static_cast<std::int16_t>(nearest_int(std::clamp(counts, double{kMinCount}, double{kMaxCount})));
}

}  // namespace

int block_samples(const RangeAxis& range) {
  return std::max(1, static_cast<int>(std::lround(kBlock_m / range.spacing_m)));
}

Array3<std::int16_t> block_means(View3<const std::int16_t> sv, View3<const SampleFlags> flags, int samples) {
  SONAR_CHECK(sv.shape() == flags.shape() && samples > 0);
  const Shape3 shape = sv.shape();
  const int blocks = (shape.samples + samples - 1) / samples;
  Array3<std::int16_t> means({shape.fans, shape.beams, blocks}, kNoData);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const std::int16_t* counts = sv.row(row).data();
    const SampleFlags* flag = flags.row(row).data();
    const auto out = means.view().row(row);
    for (int block = 0; block < blocks; ++block) {
      const int end = std::min(shape.samples, (block + 1) * samples);
      double sum = 0.0;
      int sound = 0;
      for (int s = block * samples; s < end; ++s) {
        if (counts[s] == kNoData || any(flag[s] & kNotFiltered)) continue;
        sum += linear_from_count(counts[s]);
        ++sound;
      }
      if (2 * sound < samples || !(sum > 0.0)) continue;
      out[static_cast<std::size_t>(block)] = count_from_linear(sum / sound);
    }
  }
  return means;
}

Array3<std::int16_t> block_noise(const Background& noise, const Shape3& blocks, int samples) {
  Array3<std::int16_t> mean(blocks, kMinCount);
  for (int row = 0; row < static_cast<int>(blocks.rows()); ++row) {
    if (!noise.known(row)) continue;
    const double power = noise.power_counts(row);
    const auto table = noise.calibration.row(row);
    const auto out = mean.view().row(row);
    for (int block = 0; block < blocks.samples; ++block) {
      const auto middle = static_cast<std::size_t>((block + 0.5) * samples);
      const std::int16_t calibration = table[std::min(table.size() - 1, middle)];
      if (calibration != kNoData) out[static_cast<std::size_t>(block)] = within_counts(power + calibration);
    }
  }
  return mean;
}

}  // namespace sonar
