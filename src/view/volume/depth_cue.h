// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "geo/sector.h"
#include "view/image.h"
#include "view/volume/camera.h"

namespace sonar {

/// What is far from the eye fades into the background, as through haze: near and far can be told apart.
struct DepthCue {
  Rgba8 background;
  double nearest_m = 0.0;   ///< along the camera's forward; what is nearer has its own colour
  double farthest_m = 0.0;  ///< what is farther is palest; not beyond nearest_m = nothing fades

  static constexpr double kPalest = 0.5;  ///< share of the background at the far end
  [[nodiscard]] bool on() const { return farthest_m > nearest_m; }
  /// Share of the background in what lies at a depth, 0..kPalest: linear in it.
  [[nodiscard]] double pale(double depth_m) const {
    return on() ? kPalest * std::clamp((depth_m - nearest_m) / (farthest_m - nearest_m), 0.0, 1.0) : 0.0;
  }
  friend bool operator==(const DepthCue&, const DepthCue&) = default;
};

/// From the sector's nearest to its farthest place, both in front of the eye.
[[nodiscard]] DepthCue depth_cue(const Sector& sector, const Camera& camera, Rgba8 background);

}  // namespace sonar
