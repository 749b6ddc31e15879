// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "synth/scene.h"

namespace sonar::synth {

/// The seabed of a scene: a plane, with hills and hollows about it where the scene asks for some. They are a sum of
/// waves of random bearings and lengths, drawn by the scene's seed and observation, so that there are ridges as well as
/// knolls, and none is like another.
class Terrain {
 public:
  explicit Terrain(const Scene& scene);

  /// Depth below the sea surface under a place of the scene; its z is not used.
  [[nodiscard]] double depth_m(const Point<Enu>& place) const;
  /// Depth of the plane alone.
  [[nodiscard]] double plane_m(const Point<Enu>& place) const;
  [[nodiscard]] bool is_plane() const { return waves_.empty(); }

 private:
  struct Wave {
    double east_per_m = 0.0;  ///< rad
    double north_per_m = 0.0;
    double phase = 0.0;
  };
  Water water_;
  double amplitude_m_ = 0.0;
  std::vector<Wave> waves_;
};

}  // namespace sonar::synth
