// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/frames.h"
#include "model/navigation.h"

namespace sonar {

/// Where the pings stand for following schools through time, and of how many that is reckoned instead of recorded.
struct DeadReckoning {
  std::vector<Placement> pings;  ///< [ping]; every number is known
  std::int64_t without_position = 0;
  std::int64_t without_heading = 0;
};

/// Fills what the navigation lacks, so that the ship never seems to jump; for tracking, and for the distance sailed
/// in echo integration, which counts such pings; no other table has it.
/// heading    over the shorter arc between the pings round it, held at the ends; where no ping has one the course, else 0
/// position   from the last fix on with speed and course (the heading where there is no course; of the pings round it
///            where a ping has neither), the misclosure at the next fix spread over the gap by time; before the first
///            fix backwards. Without any fix it begins at latitude and longitude 0.
/// threads    pure
[[nodiscard]] DeadReckoning dead_reckoning(std::span<const PingNavigation> pings);

}  // namespace sonar
