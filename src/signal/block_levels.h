// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "signal/flag_params.h"

namespace sonar {

// Mean count of each beam over blocks of range: what corrupted packets and interference are judged by. A mean of decibels, which
// a few strong samples hardly move; it only finds faults and reaches no result. Internal to this room.
class BlockLevels {
 public:
  static constexpr int kUnknown = std::numeric_limits<int>::min();

  /// Blocks of which too few samples are sound (kNotFiltered) are unknown.
  BlockLevels(View3<const std::int16_t> power, View3<const SampleFlags> flags, const CorruptedPacketParams& params);

  [[nodiscard]] int blocks() const { return blocks_; }
  [[nodiscard]] int block_samples() const { return block_samples_; }
  /// Counts, or kUnknown.
  [[nodiscard]] int level(int row, int block) const {
    return levels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks_) + static_cast<std::size_t>(block)];
  }
  /// The beam's own background: a low quantile of its blocks (the lower quartile); kUnknown where it has none.
  [[nodiscard]] int background(int row) const { return background_[static_cast<std::size_t>(row)]; }

 private:
  int block_samples_ = 0;
  int blocks_ = 0;
  std::vector<int> levels_;      ///< [row][block]
  std::vector<int> background_;  ///< [row]
};

/// flag_corrupted_packets() and flag_interference() with levels that are worked out once for both.
/// fan_loss_db  [row] neighbour_loss_db() to the nearest fan; empty = beams that overlap well
void flag_corrupted_packets(View3<const std::int16_t> power, const BlockLevels& levels,
                            const CorruptedPacketParams& params, std::span<const double> fan_loss_db,
                            View3<SampleFlags> flags);
void flag_interference(View3<const std::int16_t> power, const BlockLevels& levels, const InterferenceParams& params,
                       View3<SampleFlags> flags);

}  // namespace sonar
