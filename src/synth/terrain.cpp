// SPDX-License-Identifier: Apache-2.0
#include "synth/terrain.h"

#include <cmath>
#include <numbers>

#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr int kWaves = 16;
constexpr double kLongest = 4.0;  ///< hills, of the shortest
constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

Terrain::Terrain(const Scene& scene) : water_(scene.water) {
  if (water_.seabed_relief_m <= 0.0) return;
  amplitude_m_ = water_.seabed_relief_m * std::sqrt(2.0 / kWaves);
  RandomStream random(scene.seed, Purpose::relief, scene.observation);
  for (int i = 0; i < kWaves; ++i) {
    const double length_m = water_.seabed_relief_length_m * std::pow(kLongest, random.uniform());
    const double bearing = random.uniform(0.0, kTurn);
    const double phase = random.uniform(0.0, kTurn);
    waves_.push_back({kTurn / length_m * std::sin(bearing), kTurn / length_m * std::cos(bearing), phase});
  }
}

double Terrain::plane_m(const Point<Enu>& place) const {
  return water_.seabed_depth_m + water_.seabed_slope_east * place.x + water_.seabed_slope_north * place.y;
}

double Terrain::depth_m(const Point<Enu>& place) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += std::cos(wave.east_per_m * place.x + wave.north_per_m * place.y + wave.phase);
  }
  return plane_m(place) + amplitude_m_ * sum;
}

}  // namespace sonar::synth
