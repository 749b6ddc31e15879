// SPDX-License-Identifier: Apache-2.0
#include "view/volume/volume_cut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"

namespace sonar {

VolumeCut cut_before(const Sector& sector, const Point<Sonar>& eye, std::optional<int> fan, std::optional<int> beam) {
  VolumeCut out;
  if (fan) {
    const double elevation = std::atan2(-eye.z, std::hypot(eye.x, eye.y));
    const bool above = elevation >= sector.elevation_rad(*fan);
    for (int i = 0; i < sector.fans(); ++i) out.fans.push_back((above ? i <= *fan : i >= *fan) ? 1 : 0);
  }
  if (beam) {
    // The plane goes through the sonar: of a sonar that looks all round, half is left out.
    const double azimuth = std::atan2(eye.y, eye.x);
    const double at = sector.azimuth_rad(*beam);
    const double side = std::sin(azimuth - at) >= 0.0 ? 1.0 : -1.0;
    for (int i = 0; i < sector.beams(); ++i) {
      out.beams.push_back(i == *beam || side * std::sin(sector.azimuth_rad(i) - at) < 0.0 ? 1 : 0);
    }
  }
  return out;
}

void cut_away(Array3<std::int16_t>& sv, const VolumeCut& cut) {
  if (cut.fans.empty() && cut.beams.empty()) return;
  const Shape3 shape = sv.shape();
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      const bool drawn = (cut.fans.empty() || cut.fans[static_cast<std::size_t>(fan)] != 0) &&
                         (cut.beams.empty() || cut.beams[static_cast<std::size_t>(beam)] != 0);
      if (drawn) continue;
      const auto row = sv.view().row(fan * shape.beams + beam);
      std::fill(row.begin(), row.end(), kNoData);
    }
  }
}

}  // namespace sonar
