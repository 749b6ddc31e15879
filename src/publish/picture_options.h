// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/transfer_function.h"
#include "view/slices/slice_picture.h"
#include "view/sv_scale.h"
#include "view/theme.h"
#include "view/volume/camera.h"
#include "view/volume/context_scene.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// The kinds of picture, in the order of picture_kinds().
enum class PictureKind : std::uint8_t {
  slice_top,
  slice_side,
  slice_range,
  slice_plane,
  volume,
  propagation,
  observation_map,
  survey_map,
  timeline,
};

struct PictureKindInfo {
  std::string_view name;
  std::string_view text;
};
[[nodiscard]] std::span<const PictureKindInfo> picture_kinds();

/// Which back-end draws volumes.
enum class RendererChoice : std::uint8_t {
  automatic,  ///< OpenGL where it is a real GPU's, else the processor
  cpu,
  gl,
};

/// Where a plane slice lies; the first that is given counts.
struct PlaneChoice {
  std::optional<double> depth_m;                 ///< horizontal, below the sea surface
  std::optional<double> bearing_deg;             ///< vertical through the sonar, true where the heading is known
  std::optional<std::array<double, 4>> through;  ///< vertical through two places, x y x y, m (bow, starboard)
  std::optional<std::array<double, 6>> oblique;  ///< a point and a normal, x y z x y z, m (bow, starboard, down)
};

/// Everything that a picture depends on beside its source. What a kind does not know it passes over.
struct PictureOptions {
  PixelSize size{1200, 900};
  bool dark = false;
  SvScale scale;
  bool limits_given = false;  ///< scale's limits are a choice: kinds with limits of their own take them too
  std::optional<TransferFunction> transfer;  ///< view curve instead of the scale's colours
  std::optional<int> ping;                   ///< empty = the first with a school, else the middle one
  std::vector<std::int64_t> schools;         ///< empty = all
  bool masks = true;
  bool refused = false;          ///< echoes that the product tells as refused are marked; not in strips and survey maps
  std::optional<bool> filtered;  ///< noise removed; empty = in volumes yes, in slices no
  bool north_up = false;

  // slices
  std::optional<int> fan;  ///< empty = through the largest school, else the middle
  std::optional<int> beam;
  std::optional<double> range_m;
  PlaneChoice plane;
  FlagStyle flags;  ///< none: each cell with its own value; else the picture has a key of what is drawn otherwise
  bool grid_lines = false;
  std::optional<double>
      weak_below_db;  ///< samples with less signal-to-noise carry low_snr; empty = none do. Volumes too

  /// Samples that were taken out for these reasons alone are shown as recorded. Volumes too
  SampleFlags put_back = SampleFlags::none;

  // volumes
  SampleFlags left_out = kNotFiltered | SampleFlags::low_snr;  ///< samples with one of these are not drawn
  std::optional<Camera> camera;                                ///< empty = an overview
  double orbit_deg = 0.0;                                      ///< added to the camera: azimuth about its target
  double rise_deg = 0.0;                                       ///< and elevation
  double zoom = 1.0;                                           ///< above 1 = nearer
  RayMode mode = RayMode::accumulate;
  double first_hit_db = -50.0;
  bool lighting = false;
  MaskStyle mask_style;
  bool mask_outline = false;  ///< schools as outlines, not as a tint; maximum and first hit always have outlines
  int table_entries = kMostTableEntries;
  int frames = 8;        ///< jittered frames that are averaged; 0 = one plain frame
  double seconds = 0.0;  ///< no new frame is begun after this time; 0 = no limit
  RendererChoice renderer = RendererChoice::automatic;
  bool context = true;  ///< sector frame, rings, sea surface, ship, axes
  double ship_length_m = 60.0;
  std::filesystem::path depth_raster;  ///< seabed of volumes and maps; empty = none

  // propagation, maps, timeline
  int neighbours = 2;         ///< pings before and after
  bool side_view = false;     ///< propagation: from the side instead of from above
  bool along_log = false;     ///< timeline: against the log instead of time
  bool maximum = false;       ///< timeline: maximum over beams instead of mean
  bool whole_survey = false;  ///< timeline: all observations
};

[[nodiscard]] Theme theme_of(const PictureOptions& options);
/// The view curve: the transfer function given, else the scale's.
/// errors  bad_parameter
[[nodiscard]] Result<TransferFunction> view_curve(const PictureOptions& options);
/// Colours of slices and timelines.
[[nodiscard]] SvColours colours_of(const PictureOptions& options);

}  // namespace sonar
