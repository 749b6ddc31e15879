// SPDX-License-Identifier: Apache-2.0
#include "synth/seabed_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/units.h"
#include "geo/geodesic.h"
#include "geo/map_projection.h"
#include "synth/beam_table.h"
#include "synth/terrain.h"

namespace sonar::synth {
namespace {

constexpr double kMetresPerDegree = 111'195.0;
constexpr double kStep_m = 115.0;  ///< 1/16 minute of latitude, as EMODnet's grid
constexpr int kMostNodes = 500;    ///< along a side
constexpr double kAround_m = 4'000.0;
constexpr double kShallowest_m = 15.0;
constexpr double kReliefGrowsOver_m = 4'000.0;
constexpr double kRelief = 0.8;  ///< of the depth
/// Farther than this a place need not be known exactly: only the weight of a plane hangs on it.
constexpr double kExact_m = 20'000.0;

/// The course of an observation in its scene's plane.
struct Course {
  const Scene* scene = nullptr;
  Terrain terrain;
  Point<Enu> first;
  Point<Enu> last;
  double reach_m = 0.0;

  [[nodiscard]] Point<Enu> local(const Geographic& place) const {
    const Geographic& o = scene->ship.origin;
    const double north = (place.latitude_deg - o.latitude_deg) * kMetresPerDegree;
    const double east = wrap_180(place.longitude_deg - o.longitude_deg) * kMetresPerDegree *
                        std::cos(rad_from_deg((place.latitude_deg + o.latitude_deg) / 2.0));
    if (std::hypot(north, east) > kExact_m) return {east, north, 0.0};
    return to_enu(place, o);
  }
  [[nodiscard]] double distance_m(const Point<Enu>& p) const {
    const double dx = last.x - first.x;
    const double dy = last.y - first.y;
    const double length2 = dx * dx + dy * dy;
    const double along = length2 > 0.0 ? ((p.x - first.x) * dx + (p.y - first.y) * dy) / length2 : 0.0;
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(p.x - first.x - t * dx, p.y - first.y - t * dy);
  }
};

double reach_m(const Scene& scene) {
  int count = 0;
  for (const Beam& beam : scene.beams) count = std::max(count, beam.count);
  return count * kSoundSpeed_mps * kSampleInterval_s / 2.0;
}

/// Hollows of some kilometres, 0 .. 1. Never shallower than the planes: the edge of a level plain of 260 m would else be
/// a ragged isobath of 260 m.
double relief(double east_m, double north_m) {
  const auto wave = [](double v, double length_m) { return std::sin(2.0 * std::numbers::pi * v / length_m); };
  return 0.5 + 0.25 * wave(east_m + 0.4 * north_m, 9'300.0) * wave(north_m - 0.3 * east_m, 7'100.0) +
         0.15 * wave(0.7 * east_m + 0.7 * north_m + 1'000.0, 17'000.0) + 0.1 * wave(north_m - east_m, 4'300.0);
}

double depth_m(const std::vector<Course>& courses, const Geographic& place) {
  double nearest_m = std::numeric_limits<double>::infinity();
  double own_m = 0.0;
  double sum = 0.0;
  double weights = 0.0;
  for (const Course& course : courses) {
    const Point<Enu> p = course.local(place);
    const double distance = course.distance_m(p);
    const double beyond = distance - course.reach_m;
    if (beyond < nearest_m) {
      nearest_m = beyond;
      own_m = course.terrain.depth_m(p);
    }
    const double weight = 1.0 / std::max(1.0, beyond * beyond);
    sum += weight * std::max(kShallowest_m, course.terrain.plane_m(p));
    weights += weight;
  }
  if (nearest_m <= 0.0) return own_m;
  const Point<Enu> p = courses.front().local(place);
  const double grown = 1.0 - std::exp(-nearest_m / kReliefGrowsOver_m);
  return std::max(kShallowest_m, sum / weights * (1.0 + kRelief * grown * relief(p.x, p.y)));
}

}  // namespace

DepthGrid seabed_grid(const std::vector<Scene>& scenes) {
  std::vector<Course> courses;
  std::vector<Geographic> places;
  double reach = 0.0;
  for (const Scene& scene : scenes) {
    const Point<Enu> first = ship_at(scene, 0.0);
    courses.push_back({&scene, Terrain(scene), first, ship_at(scene, scene.seconds_of(scene.pings)), reach_m(scene)});
    reach = std::max(reach, courses.back().reach_m);
    places.push_back(to_geographic(first, scene.ship.origin));
    places.push_back(to_geographic(courses.back().last, scene.ship.origin));
  }
  DepthGrid grid;
  grid.source = "SYNTHETIC seabed";
  const auto tracks = extent_of(places);
  if (!tracks) return grid;
  const double across_m = (tracks->north_deg - tracks->south_deg) * kMetresPerDegree;
  const GeoExtent extent = widened(*tracks, reach + std::max(kAround_m, across_m / 3.0));
  const double height_deg = extent.north_deg - extent.south_deg;
  const double width_deg = extent.east_deg - extent.west_deg;
  const double step_deg = std::max(kStep_m / kMetresPerDegree, height_deg / (kMostNodes - 1));
  const double narrow = std::max(0.05, std::cos(rad_from_deg((extent.south_deg + extent.north_deg) / 2.0)));
  const double wide_deg = std::max(step_deg / narrow, width_deg / (kMostNodes - 1));
  grid.rows = static_cast<int>(std::ceil(height_deg / step_deg)) + 1;
  grid.columns = static_cast<int>(std::ceil(width_deg / wide_deg)) + 1;
  grid.south_deg = extent.south_deg;
  grid.west_deg = extent.west_deg;
  grid.step_latitude_deg = step_deg;
  grid.step_longitude_deg = wide_deg;
  const double step_m = std::max(step_deg, wide_deg * narrow) * kMetresPerDegree;
  for (Course& c : courses) c.reach_m += 2.0 * step_m;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Geographic place{grid.south_deg + row * step_deg, wrap_180(grid.west_deg + column * wide_deg)};
      grid.depth_m.push_back(static_cast<float>(depth_m(courses, place)));
    }
  }
  return grid;
}

}  // namespace sonar::synth
