// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/array.h"

namespace sonar {

/// Where the blocks of a window's pings lie among the places of their fans: WaterLevels tells what places are.
class Places {
 public:
  /// stretch  [ping][row]; empty for a ping = 1
  /// blocks   [fan][beam][block] of each ping
  Places(std::vector<std::vector<float>> stretch, const Shape3& blocks) : stretch_(std::move(stretch)) {
    float most = 1.0F;
    for (const std::vector<float>& of_rows : stretch_) {
      for (const float by : of_rows) most = std::max(most, by);
    }
    count_ = static_cast<int>(std::ceil(most * static_cast<float>(blocks.samples)));
    for (const std::vector<float>& of_rows : stretch_) {
      std::vector<std::int32_t>& places = of_blocks_.emplace_back();
      places.reserve(of_rows.size() * static_cast<std::size_t>(blocks.samples));
      for (const float by : of_rows) {
        for (int block = 0; block < blocks.samples; ++block) places.push_back(at(block, by));
      }
    }
  }

  /// Of each fan.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::vector<float>& stretch(std::size_t ping) const { return stretch_[ping]; }
  [[nodiscard]] float stretch(std::size_t ping, int row) const {
    return stretch_[ping].empty() ? 1.0F : stretch_[ping][static_cast<std::size_t>(row)];
  }
  /// Calls act(block, place) for each of so many blocks of a beam.
  template <class Act>
  void for_each(std::size_t ping, int row, int blocks, const Act& act) const {
    if (stretch(ping, row) == 1.0F) {
      for (int block = 0; block < blocks; ++block) act(block, block);
    } else {
      const std::int32_t* places = of_blocks_[ping].data() + static_cast<std::ptrdiff_t>(row) * blocks;
      for (int block = 0; block < blocks; ++block) act(block, places[block]);
    }
  }

 private:
  /// Of a block's middle.
  [[nodiscard]] int at(int block, float stretch) const {
    return std::min(count_ - 1, static_cast<int>((static_cast<float>(block) + 0.5F) * stretch));
  }

  std::vector<std::vector<float>> stretch_;
  std::vector<std::vector<std::int32_t>> of_blocks_;  ///< [ping][row][block] its place
  int count_ = 0;
};

}  // namespace sonar
