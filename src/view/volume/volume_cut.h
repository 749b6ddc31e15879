// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/array.h"
#include "geo/frames.h"
#include "geo/sector.h"

namespace sonar {

/// Which fans and beams of a volume are drawn, so that one can look into it.
struct VolumeCut {
  std::vector<std::uint8_t> fans;   ///< [fan] 1 = drawn; empty = all are
  std::vector<std::uint8_t> beams;  ///< [beam] the same
  friend bool operator==(const VolumeCut&, const VolumeCut&) = default;
};

/// Leaves out what lies on the eye's side of a slice; the slice itself is drawn.
/// fan   of the slice from above: fans above it are left out where the eye is above it, else those below; empty = none
/// beam  of the slice from the side: beams on the eye's side of its vertical plane are left out; empty = none
[[nodiscard]] VolumeCut cut_before(const Sector& sector, const Point<Sonar>& eye, std::optional<int> fan,
                                   std::optional<int> beam);

/// Samples that are cut away become kNoData.
/// sv  [fan][beam][sample], Sv counts
void cut_away(Array3<std::int16_t>& sv, const VolumeCut& cut);

}  // namespace sonar
