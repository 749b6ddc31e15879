// SPDX-License-Identifier: Apache-2.0
#include "synth/array/array_terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar::synth::array {

Ripples::Ripples(double shortest_m, double longest_m, int waves, RandomStream& random) {
  for (int i = 0; i < waves; ++i) {
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double length = shortest_m * std::pow(longest_m / shortest_m, random.uniform());
    const double k = 2.0 * std::numbers::pi / length;
    waves_.push_back({k * std::cos(turn), k * std::sin(turn), random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
}

double Ripples::at(double east_m, double north_m) const {
  if (waves_.empty()) return 0.0;
  double sum = 0.0;
  for (const Wave& w : waves_) sum += std::cos(w.east_per_m * east_m + w.north_per_m * north_m + w.phase);
  return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
}

double Terrain::depth_at(double east_m, double north_m) const {
  constexpr double kShallowest_m = 20.0;
  return std::max(kShallowest_m,
                  depth_m + slope_east * east_m + slope_north * north_m + roughness_m * relief.at(east_m, north_m));
}

}  // namespace sonar::synth::array
