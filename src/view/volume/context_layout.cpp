// SPDX-License-Identifier: Apache-2.0
#include "view/volume/context_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
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
