// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geo/frames.h"
#include "model/navigation.h"
#include "model/school.h"
#include "school/measure/summarise.h"
#include "school/measure/water_current.h"

namespace sonar {

/// Where and when a ship and a school come closest if both keep their velocities.
struct ClosestApproach {
  double time_s = 0.0;  ///< from now; negative = it is past
  double distance_m = 0.0;
};

/// school    place of the school's centre from the ship, metres east and north
/// relative  velocity of the school less that of the ship, m/s
/// out       empty where they move by less than 0.25 m/s against each other: the time is no figure then
/// source    two points on straight lines: t = -r.v / v.v
[[nodiscard]] std::optional<ClosestApproach> closest_approach(const Point<Enu>& school, const Point<Enu>& relative);

/// The way of the ship through an observation.
class ShipWay {
 public:
  /// pings  by ping_index; outlive it
  explicit ShipWay(std::span<const PingNavigation> pings);
  [[nodiscard]] const PingNavigation& at(std::int64_t ping_index) const;
  /// Horizontal distance of a place to where the ship sailed in the ten minutes up to a ping, in a straight line from
  /// position to position: bubbles of a wake are echo for about so long. Unknown where the ping has no position.
  [[nodiscard]] double wake_distance_m(std::int64_t ping_index, const Geographic& place) const;

 private:
  std::span<const PingNavigation> pings_;
  Geographic origin_;
  std::vector<Point<Enu>> places_;  ///< from the origin; where no position is known, nobody looks
};

/// Fills the columns of movement of one school's rows.
/// Velocity at a ping is the slope of a least-squares line through the centres within half of movement_window_s before and
/// after it; three at the least, and not where the centre is cut. Its error is of the scatter about the lines of all the
/// school's windows (line_fit.h). Away is along the horizontal line from the ship to the school's centre.
/// rows   of one school, rising time
/// water  null = no currents
/// threads  pure
void add_movement(std::span<SchoolPingRow> rows, const ShipWay& ship, const SummariseParams& params,
                  const WaterCurrents* water);

}  // namespace sonar
