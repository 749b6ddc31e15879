// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "view/colour_map.h"
#include "view/frame_description.h"
#include "view/free_place.h"
#include "view/theme.h"
#include "view/volume/camera.h"
#include "view/volume/current_arrows.h"
#include "view/volume/school_places.h"

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
  friend bool operator==(const SceneLine&, const SceneLine&) = default;
};

/// What stands round a ping's volume, as geometry in the sonar frame. Opaque things end rays; translucent ones and lines
/// do not.
struct ContextScene {
  std::vector<SceneTriangle> opaque;
  std::vector<SceneTriangle> translucent;
  std::vector<SceneTriangle> ground;  ///< translucent, always behind the volume
  std::vector<SceneLine> lines;
  /// Behind the volume alone, and behind the others: what echoes hide does not shine through them.
  std::vector<SceneLine> under;
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

/// The seabed as a plane that was fitted to a ping's echoes: z = offset_m + slope_x x + slope_y y, and where it was seen.
struct FittedSeabed {
  double offset_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double min_x = 0.0;
  double max_x = 0.0;
  double min_y = 0.0;
  double max_y = 0.0;
  [[nodiscard]] double z_at(double x, double y) const { return offset_m + slope_x * x + slope_y * y; }
  friend bool operator==(const FittedSeabed&, const FittedSeabed&) = default;
};

/// Which things are shown, and how large.
struct ContextParams {
  bool sector_frame = true;
  bool range_rings = true;  ///< rings and bearings on the sea surface
  bool sea_surface = true;
  bool ship = true;
  bool depth_axis = true;
  double ring_spacing_m = 0.0;  ///< 0 = chosen by the range
  Units units{};                ///< rings and depths stand at round numbers of them
  double ship_length_m = 60.0;
  double transducer_depth_m = 7.0;
  std::optional<double> heading_deg;  ///< bearings are labelled from true north where it is known, else from the bow
  std::optional<int> top_fan;         ///< whose outline shows where the slice from above lies
  std::optional<int> side_beam;       ///< the same of the slice from the side
  std::optional<FittedSeabed> fitted_seabed;
  std::vector<SchoolPlace> schools;  ///< have drop lines and names; labels keep off them
  CurrentColumn currents;            ///< arrows below the ship; none = nothing
  /// [row] sample from which a beam lies in schools' shadow, its record's end = nowhere; null = not shown. The same object =
  /// the same samples.
  std::shared_ptr<const std::vector<int>> shadow_from;
  /// Tracks and trails (SchoolTrails), in the sonar frame; null = none. The same object = the same lines.
  std::shared_ptr<const std::vector<SceneLine>> trails;
  friend bool operator==(const ContextParams&, const ContextParams&) = default;
};

/// Of the lines where schools' shadow lies.
[[nodiscard]] Rgba8 shadow_colour(const Theme& theme);

[[nodiscard]] ContextScene context_scene(const Sector& sector, const ContextParams& params, const Theme& theme,
                                         const std::optional<SeabedPatch>& seabed = std::nullopt);

/// Our own ship: hull, deck, superstructure and mast; waterline at z = 0, bow towards x, amidships at the origin.
[[nodiscard]] std::vector<SceneTriangle> ship_mesh(double length_m);

/// Colours of the seabed as its level parts are lit: 0 = its shallowest known depth, 1 = its deepest (see depth_span).
[[nodiscard]] ColourMap seabed_colours();
/// Smallest and largest depth of what lies below the sea, m, at least 1 m apart; empty where nothing does.
[[nodiscard]] std::optional<std::pair<double, double>> depth_span(const SeabedPatch& bed);

/// Metres of depth between a seabed's lines, which lie at round numbers of the unit of lengths; 0 where nothing is known.
[[nodiscard]] double seabed_line_step_m(const SeabedPatch& bed, const Units& units = {});
/// How many times as steep as it is a seabed is lit, 1 to 100, so that gentle slopes are seen: charts do the same. Its
/// places are true.
[[nodiscard]] double relief_exaggeration(const SeabedPatch& bed);

/// Where opaque things end rays: [height][width], metres along each pixel's ray; empty = nothing does.
struct OpaqueView {
  PixelSize size;
  std::span<const float> metres;
};

/// Depth of a seabed under a place, between its nodes; NaN where it is not known.
[[nodiscard]] double depth_under(const SeabedPatch& bed, double x_m, double y_m);

/// What a school covers of a picture, at most; empty where it is not seen.
[[nodiscard]] std::optional<PixelRect> school_box(const SchoolPlace& school, const CameraBasis& camera);
/// The same as a convex shape, which leaves more room beside it; it may reach beyond the picture.
[[nodiscard]] ConvexOutline school_outline(const SchoolPlace& school, const CameraBasis& camera);

/// Names of the schools, labels of the rings, bearings, the depth axis and the slices, where the camera sees them: each
/// beside what it names, none on another or on a school, and off the lines where there is room. What has no room, or is
/// hidden, is left out.
/// taken  where something else stands in the picture: a legend, a scale bar
void add_context_labels(FrameDescription& frame, const Sector& sector, const ContextParams& params,
                        const CameraBasis& camera, const Theme& theme, const OpaqueView& opaque = {},
                        std::span<const PixelRect> taken = {});

}  // namespace sonar
