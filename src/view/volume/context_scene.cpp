// SPDX-License-Identifier: Apache-2.0
#include "view/volume/context_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "view/volume/context_layout.h"

namespace sonar {
namespace {

Point<Sonar> cross(const Point<Sonar>& a, const Point<Sonar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void add_polyline(ContextScene& scene, const std::vector<Point<Sonar>>& points, Rgba8 colour, double width_px) {
  for (std::size_t i = 1; i < points.size(); ++i) add_straight(scene, points[i - 1], points[i], colour, width_px);
}

/// Along one fan's or one beam's edge of the sector.
void add_sector_frame(ContextScene& scene, const Sector& sector, const Theme& theme) {
  const double far_m = far_range_m(sector);
  const double near_m = std::max(0.0, sector.range().range_m(0));
  for (const int fan : {0, sector.fans() - 1}) {
    for (const double range : {near_m, far_m}) {
      std::vector<Point<Sonar>> arc;
      for (const double azimuth : even_angles(sector.azimuth_rad(0), sector.azimuth_rad(sector.beams() - 1))) {
        arc.push_back(Sector::direction(sector.elevation_rad(fan), azimuth) * range);
      }
      add_polyline(scene, arc, theme.outline, 1.5 * theme.line_px);
    }
  }
  for (const int beam : {0, sector.beams() - 1}) {
    std::vector<Point<Sonar>> arc;
    for (const double elevation : even_angles(sector.elevation_rad(0), sector.elevation_rad(sector.fans() - 1))) {
      arc.push_back(Sector::direction(elevation, sector.azimuth_rad(beam)) * far_m);
    }
    add_polyline(scene, arc, theme.outline, 1.5 * theme.line_px);
    for (const int fan : {0, sector.fans() - 1}) {
      const Point<Sonar> edge = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
      add_straight(scene, edge * near_m, edge * far_m, theme.outline, 1.5 * theme.line_px);
    }
  }
}

void add_rings(ContextScene& scene, const Sector& sector, const ContextParams& params, const Theme& theme) {
  const double z = -params.transducer_depth_m;
  const SurfaceGrid grid = surface_grid(sector, params);
  for (const double radius : grid.radii_m) {
    std::vector<Point<Sonar>> arc;
    for (const double azimuth : even_angles(grid.first_azimuth_rad, grid.last_azimuth_rad)) {
      arc.push_back(on_surface(radius, azimuth, z));
    }
    add_polyline(scene, arc, theme.ring, theme.line_px);
  }
  for (const double azimuth : grid.azimuths_rad) {
    add_straight(scene, on_surface(0.0, azimuth, z), on_surface(grid.edge_m, azimuth, z), theme.ring, theme.line_px);
  }
}

void add_sea(ContextScene& scene, const Sector& sector, const ContextParams& params) {
  const double z = -params.transducer_depth_m;
  const SurfaceGrid grid = surface_grid(sector, params);
  const std::vector<double> azimuths = even_angles(grid.first_azimuth_rad, grid.last_azimuth_rad);
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    scene.translucent.push_back({{on_surface(0.0, 0.0, z), on_surface(grid.edge_m, azimuths[i - 1], z),
                                  on_surface(grid.edge_m, azimuths[i], z)},
                                 {70, 130, 180, 34}});
  }
}

/// A rod whose every second piece is thick: no ring or edge looks so.
void add_depth_axis(ContextScene& scene, const Sector& sector, const ContextParams& params, const Theme& theme) {
  const DepthAxis axis = depth_axis(sector, params);
  const auto at_depth = [&](double depth) {
    return Point<Sonar>{axis.top.x, axis.top.y, depth - params.transducer_depth_m};
  };
  Point<Sonar> above = axis.top;
  bool thick = true;
  for (const double depth : axis.depths_m) {
    const Point<Sonar> at = at_depth(depth);
    add_straight(scene, above, at, theme.axis, (thick ? 3.5 : 1.5) * theme.line_px);
    scene.lines.push_back({at, at + axis.outwards * (0.015 * far_range_m(sector)), theme.axis, theme.line_px});
    above = at;
    thick = !thick;
  }
  if (above.z < axis.bottom.z) add_straight(scene, above, axis.bottom, theme.axis, (thick ? 3.5 : 1.5) * theme.line_px);
}

/// Outlines alone: a filled plane would have to lie between the samples before and behind it.
void add_slices(ContextScene& scene, const Sector& sector, const ContextParams& params, const Theme& theme) {
  const Rgba8 colour = with_alpha(theme.accent, 150);
  if (params.top_fan) add_polyline(scene, fan_outline(sector, *params.top_fan), colour, 1.2 * theme.line_px);
  if (params.side_beam) add_polyline(scene, beam_outline(sector, *params.side_beam), colour, 1.2 * theme.line_px);
}

/// Along the beams, from where the shadow begins to the record's end.
void add_shadow(ContextScene& scene, const Sector& sector, const std::vector<int>& from, const Theme& theme) {
  const double spacing_m = sector.range().spacing_m;
  for (std::size_t row = 0; row < from.size(); ++row) {
    if (from[row] >= sector.range().count) continue;
    const int fan = static_cast<int>(row) / sector.beams();
    const int beam = static_cast<int>(row) % sector.beams();
    const Point<Sonar> along = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
    const double begins_m = std::max(0.0, sector.range().range_m(from[row]) - 0.5 * spacing_m);
    add_straight(scene, along * begins_m, along * far_range_m(sector), shadow_colour(theme), theme.line_px);
  }
}

void add_ship(ContextScene& scene, const ContextParams& params) {
  // The transducer sits in the hull, a little ahead of amidships on most ships; amidships is near enough here.
  for (SceneTriangle triangle : ship_mesh(params.ship_length_m)) {
    for (Point<Sonar>& corner : triangle.corners) corner.z -= params.transducer_depth_m;
    triangle.colour = lit(triangle.colour, triangle.corners);
    scene.opaque.push_back(triangle);
  }
}

}  // namespace

Rgba8 shadow_colour(const Theme& theme) { return with_alpha(theme.hatch, 110); }

void add_straight(ContextScene& scene, const Point<Sonar>& from, const Point<Sonar>& to, Rgba8 colour,
                  double width_px) {
  constexpr double kPiece_m = 25.0;
  constexpr double kMostPieces = 24.0;
  const int pieces = static_cast<int>(std::clamp(std::ceil(norm(to - from) / kPiece_m), 1.0, kMostPieces));
  for (int i = 0; i < pieces; ++i) {
    const auto at = [&](int k) { return from + (to - from) * (static_cast<double>(k) / pieces); };
    scene.lines.push_back({at(i), at(i + 1), colour, width_px});
  }
}

Rgba8 lit(Rgba8 colour, const std::array<Point<Sonar>, 3>& c) {
  const Point<Sonar> normal = cross(c[1] - c[0], c[2] - c[0]);
  const double length = norm(normal);
  if (length <= 0.0) return colour;
  const double cosine = std::abs(normal.x * 0.4 - normal.y * 0.35 - normal.z * 0.85) / length;
  const double k = 0.45 + 0.55 * std::min(1.0, cosine);
  const auto scaled = [k](std::uint8_t v) { return static_cast<std::uint8_t>(std::lround(v * k)); };
  return {scaled(colour.r), scaled(colour.g), scaled(colour.b), colour.a};
}

ContextScene context_scene(const Sector& sector, const ContextParams& params, const Theme& theme,
                           const std::optional<SeabedPatch>& seabed) {
  ContextScene scene;
  if (params.sea_surface) add_sea(scene, sector, params);
  if (params.range_rings) add_rings(scene, sector, params, theme);
  if (params.sector_frame) add_sector_frame(scene, sector, theme);
  if (params.depth_axis) add_depth_axis(scene, sector, params, theme);
  if (params.ship) add_ship(scene, params);
  if (params.fitted_seabed) add_fitted_seabed(scene, *params.fitted_seabed, theme);
  if (seabed) add_seabed(scene, *seabed, params.transducer_depth_m, theme);
  add_slices(scene, sector, params, theme);
  add_drop_lines(scene, params, theme);
  if (params.shadow_from) add_shadow(scene, sector, *params.shadow_from, theme);
  add_current_arrows(scene, current_arrows(sector, params.currents, params.heading_deg, params.transducer_depth_m),
                     params.transducer_depth_m, theme);
  if (params.trails) scene.under = *params.trails;
  return scene;
}

}  // namespace sonar
