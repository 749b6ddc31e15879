// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/block_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "signal/flag_kernels.h"

namespace sonar {
namespace {

constexpr double kBlock_m = 5.5;

std::int16_t within_counts(double counts) {
  return static_cast<std::int16_t>(nearest_int(std::clamp(counts, double{kMinCount}, double{kMaxCount})));
}

constexpr std::size_t kTogether = 4;  ///< blocks whose sums grow side by side: none waits for its own last addition

struct BlockSum {
  double sum = 0.0;
  int number = 0;
};

/// Of kTogether blocks that follow each other.
void add_up(const std::int16_t* heard, std::size_t length, BlockSum* out) {
  std::array<BlockSum, kTogether> sums{};
  for (std::size_t s = 0; s < length; ++s) {
    for (std::size_t k = 0; k < kTogether; ++k) {
      const std::int16_t count = heard[k * length + s];
      sums[k].sum += linear_from_count(count);
      sums[k].number += count != kNoData ? 1 : 0;
    }
  }
  std::ranges::copy(sums, out);
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
  const auto length = static_cast<std::size_t>(samples);
  const auto groups = (static_cast<std::size_t>(blocks) + kTogether - 1) / kTogether;
  std::vector<std::int16_t> heard(groups * kTogether * length, kNoData);
  std::vector<BlockSum> sums(groups * kTogether);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    copy_unflagged(sv.row(row), flags.row(row), kNotFiltered, 0, std::span(heard).first(sv.row(row).size()));
    for (std::size_t group = 0; group < groups; ++group) {
      add_up(heard.data() + group * kTogether * length, length, sums.data() + group * kTogether);
    }
    const auto out = means.view().row(row);
    for (std::size_t block = 0; block < out.size(); ++block) {
      const auto [sum, number] = sums[block];
      if (2 * number >= samples && sum > 0.0) out[block] = count_from_linear(sum / number);
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
