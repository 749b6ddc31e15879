// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    float least = 1.0F;
    for (const std::vector<float>& of_rows : stretch_) {
      for (const float by : of_rows) {
        most = std::max(most, by);
        least = std::min(least, by);
      }
    }
    count_ = static_cast<int>(std::ceil(most * static_cast<float>(blocks.samples)));
    most_blocks_ = static_cast<int>(std::ceil(1.0F / least)) + 1;
  }

  /// Of each fan.
  [[nodiscard]] int count() const { return count_; }
  /// Of one beam that have the same place, at most.
  [[nodiscard]] int most_blocks() const { return most_blocks_; }
  [[nodiscard]] const std::vector<float>& stretch(std::size_t ping) const { return stretch_[ping]; }
  [[nodiscard]] float stretch(std::size_t ping, int row) const {
    return stretch_[ping].empty() ? 1.0F : stretch_[ping][static_cast<std::size_t>(row)];
  }
  /// Calls act(block, place) for each of so many blocks of a beam.
  template <class Act>
  void for_each(std::size_t ping, int row, int blocks, const Act& act) const {
    const float by = stretch(ping, row);
    if (by == 1.0F) {  // the usual case, and many times as fast
      for (int block = 0; block < blocks; ++block) act(block, block);
    } else {
      for (int block = 0; block < blocks; ++block) act(block, at(block, by));
    }
  }

 private:
  /// Of a block's middle.
  [[nodiscard]] int at(int block, float stretch) const {
    return std::min(count_ - 1, static_cast<int>((static_cast<float>(block) + 0.5F) * stretch));
  }

  std::vector<std::vector<float>> stretch_;
  int count_ = 0;
  int most_blocks_ = 1;
};

}  // namespace sonar
