// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// From the least to the most of what is added.
struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  [[nodiscard]] double size() const { return most - least; }
};

/// Calls visit(corner) for the corners of the cells at both ends of each run: all others lie between.
template <class Visit>
void for_each_corner(const PingMask& mask, const Sector& sector, Visit visit) {
  const RangeAxis& axis = sector.range();
  for (const Run& run : mask.runs) {
    const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
    const AngleBounds a = sector.azimuth_bounds(run.row % sector.beams());
    const double near_m = std::max(axis.range_m(run.first_sample - 0.5), 0.0);
    const double far_m = std::max(axis.range_m(run.end() - 0.5), 0.0);
    for (const double elevation : {e.lower, e.upper}) {
      for (const double azimuth : {a.lower, a.upper}) {
        const Point<Sonar> u = Sector::direction(elevation, azimuth);
        visit(u * near_m);
        visit(u * far_m);
      }
    }
  }
}

}  // namespace sonar
