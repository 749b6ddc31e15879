// SPDX-License-Identifier: Apache-2.0
#include "view/volume/mask_sections.h"

#include <algorithm>
#include <map>

namespace sonar {
namespace {

/// From the nearest sample of a row to its farthest.
struct Reach {
  int first = 0;
  int last = 0;
};
using Reaches = std::map<int, Reach>;  ///< by beam, or by fan

struct Counted {
  Reaches reaches;
  int voxels = 0;
};

void add(Counted& to, int column, const Run& run) {
  const auto [at, fresh] = to.reaches.try_emplace(column, Reach{run.first_sample, run.end() - 1});
  if (!fresh) {
    at->second.first = std::min(at->second.first, run.first_sample);
    at->second.last = std::max(at->second.last, run.end() - 1);
  }
  to.voxels += run.count;
}

const std::pair<const int, Counted>& largest(const std::map<int, Counted>& all) {
  return *std::max_element(all.begin(), all.end(),
                           [](const auto& a, const auto& b) { return a.second.voxels < b.second.voxels; });
}

/// Along the near ends, and back along the far ones; the outermost cells count as wide as they are.
/// bounds  of a column's cell; direction  of an angle between them
template <class Bounds, class Direction>
std::vector<Point<Sonar>> round(const Reaches& reaches, const RangeAxis& range, const Bounds& bounds,
                                const Direction& direction) {
  std::vector<Point<Sonar>> near;
  std::vector<Point<Sonar>> far;
  const auto at = [&](double angle, const Reach& reach) {
    const Point<Sonar> along = direction(angle);
    near.push_back(along * std::max(0.0, range.range_m(reach.first - 0.5)));
    far.push_back(along * std::max(0.0, range.range_m(reach.last + 0.5)));
  };
  at(bounds(reaches.begin()->first).lower, reaches.begin()->second);
  for (const auto& [column, reach] : reaches) {
    const AngleBounds cell = bounds(column);
    at(0.5 * (cell.lower + cell.upper), reach);
  }
  at(bounds(reaches.rbegin()->first).upper, reaches.rbegin()->second);
  near.insert(near.end(), far.rbegin(), far.rend());
  near.push_back(near.front());
  return near;
}

}  // namespace

std::vector<std::vector<Point<Sonar>>> mask_sections(const Sector& sector, const PingMask& mask) {
  if (mask.empty()) return {};
  std::map<int, Counted> fans;
  std::map<int, Counted> beams;
  for (const Run& run : mask.runs) {
    const int fan = run.row / sector.beams();
    const int beam = run.row % sector.beams();
    add(fans[fan], beam, run);
    add(beams[beam], fan, run);
  }
  const auto& [fan, of_fan] = largest(fans);
  const auto& [beam, of_beam] = largest(beams);
  return {round(
              of_fan.reaches, sector.range(), [&](int column) { return sector.azimuth_bounds(column); },
              [&, level = sector.elevation_rad(fan)](double angle) { return Sector::direction(level, angle); }),
          round(
              of_beam.reaches, sector.range(), [&](int row) { return sector.elevation_bounds(row); },
              [&, azimuth = sector.azimuth_rad(beam)](double angle) { return Sector::direction(angle, azimuth); })};
}

}  // namespace sonar
