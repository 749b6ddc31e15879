// SPDX-License-Identifier: Apache-2.0
#include "view/volume/context_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"
#include "view/axes.h"

namespace sonar {

double far_range_m(const Sector& sector) {
  return std::max(1.0, sector.range().range_m(std::max(0, sector.range().count - 1)));
}

namespace {

/// As far as the sector reaches from the sonar's vertical, m.
double reach_sideways_m(const Sector& sector) {
  const double lowest = sector.elevation_rad(0);
  const double highest = sector.elevation_rad(sector.fans() - 1);
  const double flattest = std::clamp(0.0, lowest, highest);
  return std::max(1.0, far_range_m(sector) * std::cos(flattest));
}

}  // namespace

std::vector<double> even_angles(double first_rad, double last_rad) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(last_rad - first_rad) / rad_from_deg(1.5))));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(first_rad + (last_rad - first_rad) * i / steps);
  return out;
}

Point<Sonar> on_surface(double distance_m, double azimuth_rad, double z_m) {
  return {distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad), z_m};
}

SurfaceGrid surface_grid(const Sector& sector, const ContextParams& params) {
  SurfaceGrid out;
  out.edge_m = reach_sideways_m(sector);
  const Unit unit = params.units.length();
  double spacing = params.ring_spacing_m;
  // A spacing that would draw hundreds of rings is a slip of the hand.
  if (!(spacing > out.edge_m / 50.0)) spacing = nice_ticks(0.0, unit.of(out.edge_m), 6).step * unit.si;
  for (double radius = spacing; radius <= out.edge_m * 1.0001; radius += spacing) out.radii_m.push_back(radius);
  if (out.radii_m.empty()) out.radii_m.push_back(out.edge_m);
  out.first_azimuth_rad = sector.azimuth_rad(0);
  out.last_azimuth_rad = sector.azimuth_rad(sector.beams() - 1);
  const double heading = params.heading_deg.value_or(0.0);
  const double first = deg_from_rad(out.first_azimuth_rad) + heading;
  const double last = deg_from_rad(out.last_azimuth_rad) + heading;
  const double step = last - first > 120.0 ? 30.0 : 10.0;
  for (double bearing = std::ceil(first / step) * step; bearing <= last; bearing += step) {
    out.azimuths_rad.push_back(rad_from_deg(bearing - heading));
  }
  return out;
}

std::string bearing_text(double azimuth_rad, const ContextParams& params) {
  // Rounded before wrapping: 359.99 is 000, not 360.
  return fmt::format("{:03.0f}\u00B0",
                     wrap_360(std::round(deg_from_rad(azimuth_rad) + params.heading_deg.value_or(0.0))));
}

DepthAxis depth_axis(const Sector& sector, const ContextParams& params) {
  const double far_m = far_range_m(sector);
  const double deepest = std::max(0.0, -std::sin(sector.elevation_rad(0)) * far_m) + params.transducer_depth_m;
  const double azimuth = sector.azimuth_rad(0);
  DepthAxis out;
  const double distance = far_m * std::cos(std::max(sector.elevation_rad(0), rad_from_deg(-89.0)));
  out.top = on_surface(distance, azimuth, -params.transducer_depth_m);
  out.bottom = on_surface(distance, azimuth, deepest - params.transducer_depth_m);
  // Away from the sector, along the edge of its first beam.
  out.outwards = {std::sin(azimuth), -std::cos(azimuth), 0.0};
  const Unit unit = params.units.length();
  for (const double tick : nice_ticks(0.0, unit.of(deepest), 7).major) {
    const double depth = tick * unit.si;
    if (depth > 0.0 && depth <= deepest) out.depths_m.push_back(depth);
  }
  return out;
}

namespace {

/// Of the first sample that is drawn.
double near_range_m(const Sector& sector) { return std::max(0.0, sector.range().range_m(0)); }

}  // namespace

std::vector<Point<Sonar>> fan_outline(const Sector& sector, int fan) {
  std::vector<Point<Sonar>> out;
  const double elevation = sector.elevation_rad(fan);
  const std::vector<double> azimuths = even_angles(sector.azimuth_rad(0), sector.azimuth_rad(sector.beams() - 1));
  for (const double azimuth : azimuths) out.push_back(Sector::direction(elevation, azimuth) * far_range_m(sector));
  for (auto azimuth = azimuths.rbegin(); azimuth != azimuths.rend(); ++azimuth) {
    out.push_back(Sector::direction(elevation, *azimuth) * near_range_m(sector));
  }
  out.push_back(out.front());
  return out;
}

std::vector<Point<Sonar>> beam_outline(const Sector& sector, int beam) {
  std::vector<Point<Sonar>> out;
  const double azimuth = sector.azimuth_rad(beam);
  const std::vector<double> elevations = even_angles(sector.elevation_rad(0), sector.elevation_rad(sector.fans() - 1));
  for (const double elevation : elevations) out.push_back(Sector::direction(elevation, azimuth) * far_range_m(sector));
  for (auto elevation = elevations.rbegin(); elevation != elevations.rend(); ++elevation) {
    out.push_back(Sector::direction(*elevation, azimuth) * near_range_m(sector));
  }
  out.push_back(out.front());
  return out;
}

namespace {

/// Directions to the sector's cells, a few degrees apart, the outer ones' edges among them.
std::vector<double> outer_angles(AngleBounds first, AngleBounds last) {
  const int steps = std::max(1, static_cast<int>(std::ceil((last.upper - first.lower) / rad_from_deg(4.0))));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(first.lower + (last.upper - first.lower) * i / steps);
  return out;
}

/// Where lines are seen that lie before the eye, or begin or end there.
class SeenHull {
 public:
  explicit SeenHull(const CameraBasis& camera) : camera_(&camera) {}

  void add(const Point<Sonar>& place) {
    if (const auto at = camera_->project(place); at && at->depth_m >= kNearest_m) {
      seen_.push_back({at->pixel.x, at->pixel.y});
    }
  }
  /// What a line that goes behind the eye shows last; its ends have been added.
  void add_crossing(const Point<Sonar>& from, const Point<Sonar>& to) {
    const double a = depth_m(from) - kNearest_m;
    const double b = depth_m(to) - kNearest_m;
    if ((a < 0.0) == (b < 0.0)) return;
    const auto at = camera_->project(from + (to - from) * (a / (a - b)));
    if (at) seen_.push_back({at->pixel.x, at->pixel.y});
  }
  [[nodiscard]] ConvexOutline outline() && {
    ConvexOutline out;
    for (const PlanePoint& p : convex_hull(std::move(seen_))) out.push_back({p.x, p.y});
    return out;
  }

 private:
  static constexpr double kNearest_m = 0.1;
  [[nodiscard]] double depth_m(const Point<Sonar>& place) const {
    const Point<Sonar> arm = place - camera_->eye;
    const Point<Sonar>& d = camera_->forward;
    return arm.x * d.x + arm.y * d.y + arm.z * d.z;
  }

  const CameraBasis* camera_;
  std::vector<PlanePoint> seen_;
};

/// A surface round a place, as rows of points: the lines between neighbours, and from the place.
void add_round(SeenHull& hull, const Point<Sonar>& place, const std::vector<std::vector<Point<Sonar>>>& rows) {
  hull.add(place);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      hull.add(rows[i][k]);
      hull.add_crossing(place, rows[i][k]);
      if (k > 0) hull.add_crossing(rows[i][k - 1], rows[i][k]);
      if (i > 0) hull.add_crossing(rows[i - 1][k], rows[i][k]);
    }
  }
}

}  // namespace

ConvexOutline sector_outline(const Sector& sector, const ContextParams& params, const CameraBasis& camera) {
  SeenHull hull(camera);
  const auto azimuths = outer_angles(sector.azimuth_bounds(0), sector.azimuth_bounds(sector.beams() - 1));
  std::vector<std::vector<Point<Sonar>>> far;
  for (const double elevation : outer_angles(sector.elevation_bounds(0), sector.elevation_bounds(sector.fans() - 1))) {
    far.emplace_back();
    for (const double azimuth : azimuths) {
      far.back().push_back(Sector::direction(elevation, azimuth) * far_range_m(sector));
    }
  }
  add_round(hull, {0.0, 0.0, 0.0}, far);
  const double z = -params.transducer_depth_m;
  if (params.sea_surface) {
    std::vector<Point<Sonar>> rim;
    for (const double azimuth : azimuths) rim.push_back(on_surface(reach_sideways_m(sector), azimuth, z));
    add_round(hull, {0.0, 0.0, z}, {rim});
  }
  if (params.ship) {
    for (const SceneTriangle& triangle : ship_mesh(params.ship_length_m)) {
      for (const Point<Sonar>& corner : triangle.corners) hull.add({corner.x, corner.y, corner.z + z});
    }
  }
  return std::move(hull).outline();
}

std::optional<std::pair<double, double>> depth_span(const SeabedPatch& bed) {
  double low = 1e300;
  double high = -1e300;
  for (const float depth : bed.depth_m) {
    if (!(depth > 0.0F)) continue;  // land and what is not known
    low = std::min(low, static_cast<double>(depth));
    high = std::max(high, static_cast<double>(depth));
  }
  if (low > high) return std::nullopt;
  const double spare = std::max(0.0, 1.0 - (high - low)) / 2;
  return std::pair{low - spare, high + spare};
}

}  // namespace sonar
