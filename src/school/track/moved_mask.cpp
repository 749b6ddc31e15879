// SPDX-License-Identifier: Apache-2.0
#include "school/track/moved_mask.h"

#include <algorithm>

namespace sonar {

std::vector<MovedPoint> moved_mask(const PingMask& mask, const Sector& sector, const PingFrame& from,
                                   const PingFrame& to, const Point<Enu>& shift, int every) {
  std::vector<MovedPoint> points;
  for (const Run& run : mask.runs) {
    const int fan = run.row / sector.beams();
    const int beam = run.row % sector.beams();
    const Point<Sonar> u = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
    for (int first = run.first_sample; first < run.end(); first += every) {
      const int count = std::min(every, run.end() - first);
      const double middle = first + (count - 1) / 2.0;
      const Point<Enu> place = from.to_world(u * sector.range().range_m(middle)) + shift;
      const SectorIndex index = sector.index_of(to.from_world(place));
      if (!sector.contains(index)) continue;
      points.push_back({index, count * sector.volume_m3(fan, beam, static_cast<int>(middle))});
    }
  }
  return points;
}

}  // namespace sonar
