// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/current_column.h"

#include <cmath>
#include <utility>
#include <vector>

#include "school/measure/water_current.h"

namespace sonar {

std::vector<CurrentAt> current_column(const Recipe& recipe, const PingNavigation& ship,
                                      std::span<const double> depths_m) {
  std::vector<CurrentAt> out;
  if (!ship.has_position()) return out;
  for (const double depth_m : depths_m) {
    const auto here = current_at(recipe.current_profiles, ship.time, ship.transducer, depth_m, recipe.currents);
    if (here) out.push_back({depth_m, here->east_mps, here->north_mps});
  }
  return out;
}

double longest_arrow_mps(const CurrentProfiles& profiles) {
  std::vector<double> speeds_mps;
  for (const CurrentProfile& one : profiles) {
    for (const CurrentAt& bin : one.bins) speeds_mps.push_back(std::hypot(bin.east_mps, bin.north_mps));
  }
  return longest_arrow_mps(std::move(speeds_mps));
}

}  // namespace sonar
