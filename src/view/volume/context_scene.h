// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "view/colour_map.h"
#include "view/frame_description.h"
#include "view/theme.h"
#include "view/volume/camera.h"

namespace sonar {

struct SceneTriangle {
  std::array<Point<Sonar>, 3> corners;
  Rgba8 colour;  ///< already lit
};

struct SceneLine {
  Point<Sonar> from;
  Point<Sonar> to;
  Rgba8 colour;
  double width_px = 1.0;
};

/// What stands round a ping's volume, as geometry in the sonar frame. Opaque things end rays; translucent ones and lines
/// do not.
struct ContextScene {
  std::vector<SceneTriangle> opaque;
  std::vector<SceneTriangle> translucent;
  std::vector<SceneLine> lines;
};

/// Depth of the seabed round the ship on an even grid: node (ix, iy) lies at x = first_x_m + ix * spacing_m (bow),
/// y = first_y_m + iy * spacing_m (starboard); depths below the sea surface, NaN = unknown.
struct SeabedPatch {
  int nx = 0;
  int ny = 0;
  double first_x_m = 0.0;
  double first_y_m = 0.0;
  double spacing_m = 1.0;
  std::vector<float> depth_m;  ///< [ny][nx]
};

/// Which things are shown, and how large.
struct ContextParams {
  bool sector_frame = true;
  bool range_rings = true;  ///< rings and bearings on the sea surface
  bool sea_surface = true;
  bool ship = true;
  bool depth_axis = true;
  double ring_spacing_m = 0.0;  ///< 0 = chosen by the range
  double ship_length_m = 60.0;
  double transducer_depth_m = 7.0;
  std::optional<double> heading_deg;  ///< bearings are labelled from true north where it is known, else from the bow
};

[[nodiscard]] ContextScene context_scene(const Sector& sector, const ContextParams& params, const Theme& theme,
                                         const std::optional<SeabedPatch>& seabed = std::nullopt);

/// Our own ship: hull, deck, superstructure and mast; waterline at z = 0, bow towards x, amidships at the origin.
[[nodiscard]] std::vector<SceneTriangle> ship_mesh(double length_m);

/// Colours of the seabed as its level parts are lit: 0 = its shallowest known depth, 1 = its deepest (see depth_span).
[[nodiscard]] ColourMap seabed_colours();
/// Smallest and largest depth of what lies below the sea, m, at least 1 m apart; empty where nothing does.
[[nodiscard]] std::optional<std::pair<double, double>> depth_span(const SeabedPatch& bed);

/// Metres of depth between a seabed's lines; 0 where nothing is known.
[[nodiscard]] double seabed_line_step_m(const SeabedPatch& bed);
/// How many times as steep as it is a seabed is lit, 1 to 100, so that gentle slopes are seen: charts do the same. Its
/// places are true.
[[nodiscard]] double relief_exaggeration(const SeabedPatch& bed);

/// Where opaque things end rays: [height][width], metres along each pixel's ray; empty = nothing does.
struct OpaqueView {
  PixelSize size;
  std::span<const float> metres;
};

/// Labels of the rings, bearings and the depth axis, where the camera sees them: each beside what it names, none on
/// another, and off the lines where there is room. What has no room, or is hidden, is left out.
void add_context_labels(FrameDescription& frame, const Sector& sector, const ContextParams& params,
                        const CameraBasis& camera, const Theme& theme, const OpaqueView& opaque = {});

}  // namespace sonar
