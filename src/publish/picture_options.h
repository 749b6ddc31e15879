// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "model/transfer_function.h"
#include "publish/picture_kind.h"
#include "publish/picture_params.h"
#include "view/theme.h"
#include "view/volume/camera.h"
#include "view/volume/school_trails.h"

namespace sonar {

/// Every sample with its own value, nothing marked but schools; a window begins otherwise.
[[nodiscard]] inline DisplayParams plain_display() {
  DisplayParams display;
  display.removed = display.weak = NoiseLook::shown;
  display.refused_echoes = false;
  return display;
}

/// Everything that a picture depends on beside its source. What a kind does not know it passes over.
struct PictureOptions {
  PixelSize size{1200, 900};
  double scale = 1.0;  ///< pixels of the file per pixel of the size: text and lines grow, rays are as many as pixels
  double least_text_px = 0.0;      ///< of a pixel of the size
  std::optional<PanelLook> panel;  ///< of a page: text and lines have these sizes, colour bars are left to the page
  bool dark = false;
  Units units{};  ///< that lengths and speeds are read in: a window's; programs leave SI
  DisplayParams display = plain_display();
  bool limits_given = false;  ///< the scale's limits are a choice: kinds with limits of their own take them too
  std::optional<TransferFunction> transfer;  ///< view curve instead of the scale's colours
  std::optional<int> ping;                   ///< empty = as chosen_ping(), of surfaces as with_ping_to_see()
  double towards_next = 0.0;          ///< of a movie's picture between two pings: how far to the next, 0 <= x < 1
  std::vector<std::int64_t> schools;  ///< empty = all
  /// Of slices and of what volumes show of them; empty = through the largest school, else the middle.
  std::optional<int> fan;
  std::optional<int> beam;
  VolumeParams volume;
  std::optional<std::int64_t> selected_school;  ///< highlighted in volumes
  std::optional<Camera> camera;                 ///< in place of the one that `kind` names
  PictureParams kind;                           ///< what is asked for one kind alone
  std::filesystem::path depth_raster;           ///< seabed of volumes and maps; empty = none
  std::filesystem::path transects;              ///< table of them for the survey map; empty = none
  std::filesystem::path line;                   ///< Echoview's (.evl), over an echogram against depth; empty = none
};

/// Refuses what no picture can be made of, before anything is read.
/// errors  bad_parameter: out of range, too many pixels, places that are no numbers or make no plane or camera
[[nodiscard]] Result<void> validate_options(const PictureOptions& options);

[[nodiscard]] Theme theme_of(const PictureOptions& options);
/// The view curve: the transfer function given, else the scale's.
/// errors  bad_parameter
[[nodiscard]] Result<TransferFunction> view_curve(const PictureOptions& options);
/// Colours of slices and timelines.
[[nodiscard]] SvColours colours_of(const PictureOptions& options);
/// How schools look in volumes.
[[nodiscard]] MaskStyle mask_style(const DisplayParams& display, const VolumeParams& volume);

/// Which tracks and trails stand round a volume; none where nothing does.
[[nodiscard]] TrailParams trail_params(const VolumeParams& volume);

/// A plane through the water, m (bow, starboard, down).
struct PlanePlaces {
  std::array<double, 4> through{};  ///< two places on it, x y x y
  std::array<double, 3> point{};
  std::array<double, 3> normal{};
};
/// The places that a plane's texts name.
/// errors  bad_parameter: no numbers
[[nodiscard]] Result<PlanePlaces> places_of(const PlaneSliceParams& params);
/// The camera that is named; empty where none is.
/// errors  bad_parameter: no numbers, an eye without a target, both in one place
[[nodiscard]] Result<std::optional<Camera>> named_camera(const CameraParams& params);

}  // namespace sonar
