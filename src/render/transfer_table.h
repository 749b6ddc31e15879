// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "view/volume/volume_scene.h"

namespace sonar {

struct TableEntry {
  float extinction = 0.0F;   ///< m^-1
  std::uint32_t rgb10 = 0U;  ///< red | green << 10 | blue << 20, each 0..1023
};

/// An OpticalTable made ready for rays: so fine that the nearest entry will do, and able to say quickly what a range of
/// Sv can do. Entry = clamp(count * per_count + first, 0, size - 1), rounded to the nearest.
struct TransferTable {
  float per_count = 0.0F;
  float first = 0.0F;
  std::vector<float> extinction;             ///< [size] m^-1
  std::vector<TableEntry> entries;           ///< [size] both, side by side: one look at memory
  std::vector<std::int32_t> visible_before;  ///< [size + 1] entries above 0 before this one
  std::vector<std::vector<float>> largest;   ///< [level][i] largest extinction of entries i .. i + 2^level - 1

  [[nodiscard]] int size() const { return static_cast<int>(extinction.size()); }
  /// Whether any entry for counts of [least, largest] is visible; one entry more to each side.
  [[nodiscard]] bool visible(int least_count, int largest_count) const;
  /// Largest extinction for counts of [least, largest], one entry more to each side.
  [[nodiscard]] float largest_extinction(int least_count, int largest_count) const;
  /// Lowest Sv whose extinction is above 0, dB; +infinity where nothing is visible.
  double lowest_visible_db = 0.0;
};

[[nodiscard]] TransferTable transfer_table(const OpticalTable& table);

/// r, g, b, extinction at a level: linear between entries, constant outside.
[[nodiscard]] std::array<double, 4> optics_at(const OpticalTable& table, double sv_db);

}  // namespace sonar
