// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/mask.h"
#include "school/mask_shape.h"

namespace sonar {

/// The box along a body's own axes that its cells just fit in, m.
struct OrientedBox {
  double length_m = 0.0;     ///< the longest side
  double width_m = 0.0;      ///< the next
  double thickness_m = 0.0;  ///< the shortest
  double bearing_deg = 0.0;  ///< of the longest, clockwise from true north, [0, 180)
  double tilt_deg = 0.0;     ///< elevation of its end on that bearing, positive up, [-90, 90]
};
/// Paths are taken for straight, whether or not the placement has rays.
/// mask  not empty
/// axes  of its covariance, sonar frame
[[nodiscard]] OrientedBox oriented_box(const PingMask& mask, const PrincipalAxes& axes, const Sector& sector,
                                       const Placement& placement);

}  // namespace sonar
