// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sonar {

/// WaterLevels::patch counts in such steps, 0.19 dB.
inline constexpr int kPatchStep = 16;

/// A block of one beam that stands out of its water.
struct EchoCell {
  std::int32_t row = 0;    ///< fan * beams + beam
  std::int32_t block = 0;  ///< of WaterLevels
  float evidence = 0.0F;   ///< how far it stands out, in spreads of the water itself
  friend bool operator==(const EchoCell&, const EchoCell&) = default;
};

/// What a ping's water shows where there is no school, by fan and range, and what stands out of it. Beams of one fan are
/// compared at equal shares of their range to the seabed, where one is found: block = sample x stretch / block_samples.
struct WaterLevels {
  std::int32_t block_samples = 0;   ///< 0 = nothing is known
  std::int32_t blocks = 0;          ///< of each beam
  std::vector<float> stretch;       ///< [row]; empty = 1 everywhere
  std::vector<std::int16_t> level;  ///< [fan][block] mean of the water, Sv counts; kMinCount = not known
  std::vector<std::int8_t>
      patch;  ///< [row][block] louder than that or than the noise in this ping, kPatchStep; empty = 0
  std::vector<std::int16_t> reach;  ///< [fan][block] so far above that single beams of it reach, counts
  std::vector<EchoCell> cells;      ///< by (row, block)

  [[nodiscard]] bool known() const { return block_samples > 0; }
  [[nodiscard]] double stretch_of(int row) const {
    return stretch.empty() ? 1.0 : static_cast<double>(stretch[static_cast<std::size_t>(row)]);
  }
  /// Fractional block of a sample's centre; whole numbers are the centres of blocks.
  [[nodiscard]] double block_at(int row, double sample) const {
    return (sample + 0.5) * stretch_of(row) / block_samples - 0.5;
  }
  /// First sample of a block.
  [[nodiscard]] int first_sample(int row, int block) const {
    return static_cast<int>(std::ceil(block * block_samples / stretch_of(row) - 0.5));
  }
  friend bool operator==(const WaterLevels&, const WaterLevels&) = default;
};

}  // namespace sonar
