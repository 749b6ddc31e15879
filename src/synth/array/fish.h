// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "synth/array/params.h"

namespace sonar::synth::array {

/// Backscattering cross-section of a fish seen broadside, m^2.
[[nodiscard]] double broadside_m2(const FishParams& params, double length_cm);

/// How much of the broadside echo comes back at an aspect: a line as long as the swimbladder, (sin x / x)^2 with
/// x = k l sin(angle off broadside), over the share of any aspect.
/// along  cosine between the fish's axis and the direction to it
[[nodiscard]] double aspect(const FishParams& params, double wave_number, double length_cm, double along);

/// Axis of a fish as east, north, up; tilt is positive head up.
[[nodiscard]] Point<Enu> fish_axis(double heading_rad, double tilt_rad);

/// The mean of aspect() over the headings and tilts of a school, by where the school is seen from.
class MeanAspect {
 public:
  MeanAspect(const FishParams& params, double wave_number, double length_cm);
  /// seen         unit vector to the school
  /// heading_rad  its mean heading
  [[nodiscard]] double at(const Point<Enu>& seen, double heading_rad) const;

 private:
  std::vector<double> table_;  ///< [relative bearing][elevation]
};

}  // namespace sonar::synth::array
