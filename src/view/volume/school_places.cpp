// SPDX-License-Identifier: Apache-2.0
#include "view/volume/school_places.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geo/geodesic.h"
#include "model/mask_middle.h"

namespace sonar {
namespace {

/// What a mask takes up of one fan.
struct FanBox {
  int first_beam = std::numeric_limits<int>::max();
  int last_beam = -1;
  int first_sample = std::numeric_limits<int>::max();
  int last_sample = -1;
};

std::map<int, FanBox> boxes_of(const PingMask& mask, int beams) {
  std::map<int, FanBox> boxes;
  for (const Run& run : mask.runs) {
    FanBox& box = boxes[run.row / beams];
    box.first_beam = std::min(box.first_beam, run.row % beams);
    box.last_beam = std::max(box.last_beam, run.row % beams);
    box.first_sample = std::min(box.first_sample, run.first_sample);
    box.last_sample = std::max(box.last_sample, run.end() - 1);
  }
  return boxes;
}

/// The box's corners and the middles of its two arcs, which reach beyond the corners.
void add_box(std::vector<Point<Sonar>>& edge, const Sector& sector, int fan, const FanBox& box) {
  const int low = std::max(0, box.first_beam - 1);
  const int high = std::min(sector.beams() - 1, box.last_beam + 1);
  const int near = std::max(0, box.first_sample - 1);
  const int far = std::min(sector.range().count - 1, box.last_sample + 1);
  constexpr int kSteps = 4;
  for (int i = 0; i <= kSteps; ++i) {
    const int beam = low + (high - low) * i / kSteps;
    for (const int sample : {near, far}) edge.push_back(sector.centre(fan, beam, sample));
  }
}

/// Of a mask's cells at their beams' elevations.
std::vector<Point<Sonar>> footprint_of(const Sector& sector, const PingMask& mask) {
  std::vector<PlanePoint> corners;
  for (const Run& run : mask.runs) {
    const AngleBounds bounds = sector.azimuth_bounds(run.row % sector.beams());
    const double elevation = sector.elevation_rad(run.row / sector.beams());
    for (const double azimuth : {bounds.lower, bounds.upper}) {
      for (const double sample : {run.first_sample - 0.5, run.end() - 0.5}) {
        const Point<Sonar> p = Sector::direction(elevation, azimuth) * sector.range().range_m(sample);
        corners.push_back({p.x, p.y});
      }
    }
  }
  std::vector<Point<Sonar>> out;
  for (const PlanePoint& p : convex_hull(std::move(corners))) {
    out.push_back({p.x, p.y, std::numeric_limits<double>::quiet_NaN()});
  }
  return out;
}

}  // namespace

std::optional<SchoolPlace> school_place(const Sector& sector, const PingMask& mask) {
  const auto middle = mask_middle(mask, sector.beams());
  if (!middle) return std::nullopt;
  SchoolPlace out;
  out.middle = sector.centre(middle->fan, middle->beam, middle->sample);
  const std::map<int, FanBox> boxes = boxes_of(mask, sector.beams());
  for (const auto& [fan, box] : boxes) add_box(out.edge, sector, fan, box);
  const auto& [lowest, lowest_box] = *boxes.begin();
  const auto& [highest, highest_box] = *boxes.rbegin();
  if (lowest > 0) add_box(out.edge, sector, lowest - 1, lowest_box);
  if (highest + 1 < sector.fans()) add_box(out.edge, sector, highest + 1, highest_box);
  out.footprint = footprint_of(sector, mask);
  return out;
}

}  // namespace sonar
