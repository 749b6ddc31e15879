// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/filled_volume.h"
#include "render/transfer_table.h"

namespace sonar {

inline constexpr int kCellSamples = 16;  ///< range samples a cell; 1 beam and 1 fan

/// Least and largest known Sv of each cell, neighbours on its faces included: what interpolation inside can yield.
/// Axes [fan cell][beam cell][range cell], range fastest: (fans - 1) x (beams - 1) x ceil((samples - 1) / 16).
struct Macrocells {
  int fans = 0;
  int beams = 0;
  int ranges = 0;
  std::vector<std::int16_t> least;  ///< above `largest` where nothing is known
  std::vector<std::int16_t> largest;
  std::vector<std::uint8_t> gaps;  ///< 1 where some of the cell's samples are unknown; empty where none is anywhere
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(fans) * static_cast<std::size_t>(beams) * static_cast<std::size_t>(ranges);
  }
};

[[nodiscard]] Macrocells macrocells(const FilledVolume& volume);

/// 1 where a cell may hold something visible under the table (accumulation); never 0 where it does.
[[nodiscard]] std::vector<std::uint8_t> visible_cells(const Macrocells& cells, const TransferTable& table);
/// 1 where a cell reaches a level (first hit, maximum).
[[nodiscard]] std::vector<std::uint8_t> cells_reaching(const Macrocells& cells, double level_db);

/// Chebyshev distance in cells to the next one set, 0 in it, 255 at most: the block of distance - 1 cells to each side
/// of an unset cell is empty.
[[nodiscard]] std::vector<std::uint8_t> empty_distance(const Macrocells& cells, const std::vector<std::uint8_t>& set);

}  // namespace sonar
