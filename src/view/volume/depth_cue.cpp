// SPDX-License-Identifier: Apache-2.0
#include "view/volume/depth_cue.h"

#include <limits>

namespace sonar {

DepthCue depth_cue(const Sector& sector, const Camera& camera, Rgba8 background) {
  const CameraBasis seen = basis(camera, {1, 1});
  const RangeAxis& range = sector.range();
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (int f = 0; f < sector.fans(); ++f) {
    for (int b = 0; b < sector.beams(); ++b) {
      const Point<Sonar> out = Sector::direction(sector.elevation_rad(f), sector.azimuth_rad(b));
      for (const double r : {std::max(0.0, range.first_m), range.range_m(range.count - 1)}) {
        const Point<Sonar> d = out * r - seen.eye;
        const double depth = d.x * seen.forward.x + d.y * seen.forward.y + d.z * seen.forward.z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
      }
    }
  }
  return {background, std::max(0.0, nearest), farthest};
}

}  // namespace sonar
