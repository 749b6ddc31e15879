// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "synth/random.h"

namespace sonar::synth::array {

/// Waves over a plane, drawn at random: a field with zero mean and unit variance, the same whenever it is asked.
class Ripples {
 public:
  Ripples() = default;
  Ripples(double shortest_m, double longest_m, int waves, RandomStream& random);
  [[nodiscard]] double at(double east_m, double north_m) const;

 private:
  struct Wave {
    double east_per_m, north_per_m, phase;
  };
  std::vector<Wave> waves_;
};

/// The seabed: a slope with roughness, and patches that scatter more and less.
struct Terrain {
  bool there = false;
  double depth_m = 0.0;  ///< at the scene's origin
  double slope_east = 0.0;
  double slope_north = 0.0;
  double roughness_m = 0.0;  ///< standard deviation
  double strength = 0.0;     ///< Lambert's constant, linear
  Ripples relief;
  Ripples patches;

  [[nodiscard]] double depth_at(double east_m, double north_m) const;
};

}  // namespace sonar::synth::array
