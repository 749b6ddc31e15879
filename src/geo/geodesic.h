// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "geo/frames.h"

namespace sonar {

struct GeodesicStep {
  double distance_m = 0.0;
  double bearing_deg = 0.0;  ///< at the start, clockwise from true north, [0, 360)
};

/// Shortest way between two places on the WGS 84 ellipsoid (Karney's algorithm, PROJ).
[[nodiscard]] GeodesicStep geodesic(const Geographic& from, const Geographic& to);
/// Where one arrives.
[[nodiscard]] Geographic destination(const Geographic& from, double distance_m, double bearing_deg);

/// Place of a point in the local frame of `origin` (its height is not used).
[[nodiscard]] Geographic to_geographic(const Point<Enu>& p, const Geographic& origin);
/// The other way; z = 0.
[[nodiscard]] Point<Enu> to_enu(const Geographic& place, const Geographic& origin);

/// Convex hull, counter-clockwise, without the repeated first point; fewer than 3 points when degenerate.
struct PlanePoint {
  double x = 0.0;
  double y = 0.0;
  friend auto operator<=>(const PlanePoint&, const PlanePoint&) = default;
};
[[nodiscard]] std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

}  // namespace sonar
