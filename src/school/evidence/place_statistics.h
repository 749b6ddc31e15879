// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/units.h"
#include "school/evidence/places.h"

namespace sonar {

/// What the values of one place tell.
struct PlaceStatistics {
  std::int16_t middle = kNoData;
  std::int16_t below = 0;  ///< down to the 16th percentile
  std::int16_t above = 0;  ///< up to the 84th
};

/// How values change from block to block. Towards the seabed levels rise by 10 dB and more a block, and are told in the middle of
/// each place, between the blocks on either side of it; what has no trend goes to the place that its block lies in. Where most of
/// a place stands 10 dB (of evidence: 3.3 spreads) clear of a quarter or more, that rest tells: of levels by their lopsided
/// spread, without a trend by a middle that is not about 0.
enum class Trend { none, steep };

/// For each place of a fan what the values of all pings and beams there tell; too few are joined by those of the places
/// beside, and where even these are too few, what lies nearer and farther is interpolated.
/// of_pings  [ping][fan][beam][block]
/// masked    same shape; values whose mark is not 0 have no say
/// returns   [fan][place]
[[nodiscard]] std::vector<PlaceStatistics> statistics_of_places(const std::vector<Array3<std::int16_t>>& of_pings,
                                                                const std::vector<Array3<std::uint8_t>>& masked,
                                                                const Places& places, Trend trend);

}  // namespace sonar
