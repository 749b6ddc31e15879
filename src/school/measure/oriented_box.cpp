// SPDX-License-Identifier: Apache-2.0
#include "school/measure/oriented_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/units.h"
#include "school/measure/mask_corners.h"

namespace sonar {

OrientedBox oriented_box(const PingMask& mask, const PrincipalAxes& axes, const Sector& sector,
                         const Placement& placement) {
  std::array<Extent, 3> extents;
  for_each_corner(mask, sector, [&](const Point<Sonar>& corner) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& axis = axes.axis[k];
      extents[k].add(corner.x * axis[0] + corner.y * axis[1] + corner.z * axis[2]);
    }
  });
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return extents[a].size() > extents[b].size(); });
  OrientedBox box;
  box.length_m = extents[order[0]].size();
  box.width_m = extents[order[1]].size();
  box.thickness_m = extents[order[2]].size();
  const Vector3& longest = axes.axis[order[0]];
  const Point<Sonar> level = levelled_direction(Point<Sonar>{longest[0], longest[1], longest[2]}, placement);
  const Point<Enu> axis = to_enu(level, placement.heading_rad);
  box.bearing_deg = wrap_360(deg_from_rad(std::atan2(axis.x, axis.y)));
  box.tilt_deg = deg_from_rad(std::atan2(axis.z, std::hypot(axis.x, axis.y)));
  if (box.bearing_deg >= 180.0) {  // its other end
    box.bearing_deg -= 180.0;
    box.tilt_deg = -box.tilt_deg;
  }
  return box;
}

}  // namespace sonar
