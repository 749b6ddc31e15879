// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "view/volume/context_scene.h"

namespace sonar {

/// Range of the last sample, m; at least 1.
[[nodiscard]] double far_range_m(const Sector& sector);

/// Angles from first to last, 1.5 degrees apart or closer, both ends among them.
[[nodiscard]] std::vector<double> even_angles(double first_rad, double last_rad);

/// A place on a level z at a horizontal distance, azimuth clockwise from the bow.
[[nodiscard]] Point<Sonar> on_surface(double distance_m, double azimuth_rad, double z_m);

/// Rings and bearings as drawn on the sea surface.
struct SurfaceGrid {
  double edge_m = 1.0;          ///< where the sector ends, as far as it reaches sideways
  std::vector<double> radii_m;  ///< rising, at least one, none beyond the edge
  double first_azimuth_rad = 0.0;
  double last_azimuth_rad = 0.0;
  std::vector<double> azimuths_rad;  ///< of the bearing lines; whole tens of degrees as they are labelled
};
[[nodiscard]] SurfaceGrid surface_grid(const Sector& sector, const ContextParams& params);
/// "283°": from true north where the heading is known, else from the bow; clockwise.
[[nodiscard]] std::string bearing_text(double azimuth_rad, const ContextParams& params);

/// A depth scale at the sector's far aft edge, from the sea surface to the sector's deepest place.
struct DepthAxis {
  Point<Sonar> top;
  Point<Sonar> bottom;
  Point<Sonar> outwards;         ///< unit vector, level
  std::vector<double> depths_m;  ///< of the ticks, below the sea surface
};
[[nodiscard]] DepthAxis depth_axis(const Sector& sector, const ContextParams& params);

/// One light from above and ahead of port, as on a chart; both sides of a face are lit alike.
[[nodiscard]] Rgba8 lit(Rgba8 colour, const std::array<Point<Sonar>, 3>& corners);

/// Where the slice from above or from the side ends: along the edges of its fan or beam, closed.
[[nodiscard]] std::vector<Point<Sonar>> fan_outline(const Sector& sector, int fan);
[[nodiscard]] std::vector<Point<Sonar>> beam_outline(const Sector& sector, int beam);

/// What the sector's cells cover of a picture, with the sea surface and the ship where these are shown: the convex hull of
/// what lies before the eye, which may reach far beyond the picture; empty where nothing does.
[[nodiscard]] ConvexOutline sector_outline(const Sector& sector, const ContextParams& params,
                                           const CameraBasis& camera);

/// A muted plane where the seabed was seen, with a grid and an edge.
void add_fitted_seabed(ContextScene& scene, const FittedSeabed& bed, const Theme& theme);

/// Lines straight up and down from the schools that have them, with the school's footprint at each end.
void add_drop_lines(ContextScene& scene, const ContextParams& params, const Theme& theme);

/// A straight line in pieces: farther ones are drawn paler.
void add_straight(ContextScene& scene, const Point<Sonar>& from, const Point<Sonar>& to, Rgba8 colour, double width_px);

/// Faces lit as a relief, lines of equal depth, and a grid ahead and across.
void add_seabed(ContextScene& scene, const SeabedPatch& bed, double transducer_depth_m, const Theme& theme);

}  // namespace sonar
