// SPDX-License-Identifier: Apache-2.0
#include "signal/block_levels.h"

#include <algorithm>

#include "signal/flag_kernels.h"

namespace sonar {

BlockLevels::BlockLevels(View3<const std::int16_t> power, View3<const SampleFlags> flags,
                         const CorruptedPacketParams& params) {
  const Shape3 shape = power.shape();
  const auto block = static_cast<std::size_t>(std::max(params.block_samples, 1));
  const auto samples = static_cast<std::size_t>(shape.samples);
  const std::size_t blocks = (samples + block - 1) / block;
  block_samples_ = static_cast<int>(block);
  blocks_ = static_cast<int>(blocks);
  levels_.resize(shape.rows() * blocks, kUnknown);
  background_.resize(shape.rows(), kUnknown);
  std::vector<std::int16_t> sound(samples);
  std::vector<std::int32_t> sums(blocks);
  std::vector<std::int32_t> numbers(blocks);
  std::vector<int> known;
  const double least = params.block_sound_share * static_cast<double>(block);
  for (std::size_t row = 0; row < shape.rows(); ++row) {
    copy_unflagged(power.row(static_cast<int>(row)), flags.row(static_cast<int>(row)), kNotFiltered, 0, sound);
    block_sums(sound, block, sums, numbers);
    known.clear();
    for (std::size_t b = 0; b < blocks; ++b) {
      if (numbers[b] < least || numbers[b] == 0) continue;
      levels_[row * blocks + b] = sums[b] / numbers[b];
      known.push_back(levels_[row * blocks + b]);
    }
    if (known.empty()) continue;
    const double below = params.background_share * static_cast<double>(known.size());
    const auto quantile = known.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(known.begin(), quantile, known.end());
    background_[row] = *quantile;
  }
}

}  // namespace sonar
