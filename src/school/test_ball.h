// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "base/units.h"
#include "geo/geodesic.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/track/motion.h"

namespace sonar::test {

/// A ball of fish over ground: what a perfect sonar without beam width would mark.
struct Ball {
  Point<Enu> start;
  Point<Enu> velocity;
  double radius_m = 12.0;
  double reference_db = -40.0;
};

inline constexpr double kInterval_s = 5.0;

inline Placement ship_at(int ping, double speed_mps = 3.0, Geographic start = {60.0, 4.0}, double heading_deg = 0.0) {
  Placement p;
  p.heading_rad = rad_from_deg(heading_deg);
  const double way = speed_mps * kInterval_s * ping;
  p.transducer = to_geographic(Point<Enu>{way * std::sin(p.heading_rad), way * std::cos(p.heading_rad), 0.0}, start);
  return p;
}

inline PingMask ball_mask(const Ball& ball, const Sector& sector, const Placement& placement, Geographic origin,
                          double t) {
  const PingFrame frame(placement, origin);
  const Point<Sonar> centre = frame.from_world(ball.start + ball.velocity * t);
  PingMask mask;
  for (int row = 0; row < 500; ++row) {
    for (int s = 0; s < sector.range().count; ++s) {
      if (std::abs(sector.range().range_m(s) - norm(centre)) > ball.radius_m) continue;
      if (norm(sector.centre(row / 25, row % 25, s) - centre) > ball.radius_m) continue;
      if (mask.runs.empty() || mask.runs.back().row != row || mask.runs.back().end() != s)
        mask.runs.push_back({row, s, 0});
      ++mask.runs.back().count;
      mask.confidence.push_back(255);
    }
  }
  return mask;
}

}  // namespace sonar::test
