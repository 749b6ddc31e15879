// SPDX-License-Identifier: Apache-2.0
#include "school/measure/cell_steps.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "base/units.h"
#include "school/mask_shape.h"

namespace sonar {
namespace {

/// Edges of the cell at a place: across fans, across beams, along range.
std::array<Point<Sonar>, 3> cell_edges(const Sector& sector, const Point<Sonar>& place) {
  const int row = sector.row_towards(place);
  const AngleBounds elevation = sector.elevation_bounds(row / sector.beams());
  const AngleBounds azimuth = sector.azimuth_bounds(row % sector.beams());
  const double elevation_rad = 0.5 * (elevation.lower + elevation.upper);
  const double azimuth_rad = 0.5 * (azimuth.lower + azimuth.upper);
  const double range = norm(place);
  return {(Sector::direction(elevation.upper, azimuth_rad) - Sector::direction(elevation.lower, azimuth_rad)) * range,
          (Sector::direction(elevation_rad, azimuth.upper) - Sector::direction(elevation_rad, azimuth.lower)) * range,
          Sector::direction(elevation_rad, azimuth_rad) * sector.range().spacing_m};
}

}  // namespace

FigureValues cell_steps(const MeasureInput& ping, const PingMask& mask, const SchoolPingRow& row) {
  const MaskShape shape = shape_of(mask, *ping.sector);
  FigureValues steps{};
  if (!(shape.weight > 0.0)) return steps;
  const auto edges = cell_edges(*ping.sector, shape.centre);
  const PrincipalAxes axes = principal_axes(shape.covariance);
  const auto along_box = [&](std::size_t k) {  // the longest axis of a box is that of the largest variance, mostly
    const Vector3& axis = axes.axis[k];
    double square = 0.0;
    for (const Point<Sonar>& e : edges) square += std::pow(e.x * axis[0] + e.y * axis[1] + e.z * axis[2], 2);
    return std::sqrt(square);
  };
  const auto levelled_along = [&](double east, double north, double down) {
    double square = 0.0;
    for (const Point<Sonar>& e : edges) {
      const Point<Sonar> level = levelled_direction(e, ping.placement);
      const Point<Enu> p = to_enu(level, ping.placement.heading_rad);
      square += std::pow(p.x * east + p.y * north + level.z * down, 2);
    }
    return std::isfinite(square) ? std::sqrt(square) : 0.0;
  };
  const double s = std::sin(rad_from_deg(row.axis_deg));
  const double c = std::cos(rad_from_deg(row.axis_deg));
  const auto put = [&](std::string_view figure, double step) {
    for (std::size_t i = 0; i < kErrorCount; ++i) {
      if (kErrorColumns[i].figure == figure && std::isfinite(step)) steps[i] = step;
    }
  };
  put("length_m", levelled_along(s, c, 0.0));
  put("width_m", levelled_along(c, -s, 0.0));
  for (const std::string_view figure : {"height_m", "surface_distance_m", "bottom_distance_m"}) {
    put(figure, levelled_along(0.0, 0.0, 1.0));
  }
  put("box_length_m", along_box(0));
  put("box_width_m", along_box(1));
  put("box_thickness_m", along_box(2));
  put("diner_nb_across", row.diner_nb_across / static_cast<double>(row.n_beams));
  put("diner_nb_height", row.diner_nb_height / static_cast<double>(row.n_fans));
  return steps;
}

}  // namespace sonar
