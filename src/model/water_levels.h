// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sonar {

/// WaterLevels::patch counts in such steps, 0.19 dB.
inline constexpr int kPatchStep = 16;

/// A block of one beam that lies above its background.
struct EchoCell {
  std::int32_t row = 0;    ///< fan * beams + beam
  std::int32_t block = 0;  ///< of WaterLevels
  float evidence = 0.0F;   ///< how far it lies above it, in spreads of the water itself
  friend bool operator==(const EchoCell&, const EchoCell&) = default;
};

/// What a ping's water shows where there is no school, and what lies above it. Blocks lie at equal ranges. The water's
/// levels are told for places of a fan, which all its beams share: blocks too, but counted by the share of each beam's way to
/// the seabed, where one is found: place = sample x stretch / block_samples.
struct WaterLevels {
  std::int32_t block_samples = 0;   ///< 0 = nothing is known
  std::int32_t blocks = 0;          ///< of each beam
  std::int32_t places = 0;          ///< of each fan
  std::vector<float> stretch;       ///< [row]; empty = 1 everywhere
  std::vector<std::int16_t> level;  ///< [fan][place] mean of the water, Sv counts; kMinCount = not known
  std::vector<std::int8_t>
      patch;  ///< [row][block] louder than that or than the noise in this ping, kPatchStep; empty = 0
  std::vector<std::int16_t> reach;  ///< [fan][place] so far above that single beams of it reach, counts
  std::vector<EchoCell> cells;      ///< by (row, block)

  [[nodiscard]] bool known() const { return block_samples > 0; }
  [[nodiscard]] double stretch_of(int row) const {
    return stretch.empty() ? 1.0 : static_cast<double>(stretch[static_cast<std::size_t>(row)]);
  }
  /// Fractional block of a sample's centre; whole numbers are the centres of blocks.
  [[nodiscard]] double block_at(double sample) const { return (sample + 0.5) / block_samples - 0.5; }
  /// The same of places.
  [[nodiscard]] double place_at(int row, double sample) const {
    return (sample + 0.5) * stretch_of(row) / block_samples - 0.5;
  }
  friend bool operator==(const WaterLevels&, const WaterLevels&) = default;
};

}  // namespace sonar
