// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "base/units.h"
#include "geo/frames.h"

namespace sonar {

/// Great circle on a sphere, m: right to half a per cent, by another formula than the program's; for tests.
inline double sphere_m(const Geographic& a, const Geographic& b) {
  constexpr double kEarth_m = 6371000.0;
  const double lat_a = rad_from_deg(a.latitude_deg);
  const double lat_b = rad_from_deg(b.latitude_deg);
  const double h =
      std::pow(std::sin((lat_b - lat_a) / 2.0), 2) +
      std::cos(lat_a) * std::cos(lat_b) * std::pow(std::sin(rad_from_deg(b.longitude_deg - a.longitude_deg) / 2.0), 2);
  return 2.0 * kEarth_m * std::asin(std::sqrt(h));
}

}  // namespace sonar
