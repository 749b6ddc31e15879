// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/frame_description.h"
#include "view/theme.h"
#include "view/volume/camera.h"

namespace sonar {

/// How long a distance looks in a picture in perspective. It holds across the line of sight at the camera's target, in
/// the middle of the picture; nearer things look larger.
struct DistanceBar {
  double length_m = 0.0;  ///< 1, 2 or 5 times a power of ten of the unit
  double length_px = 0.0;
};

/// The longest that is no longer than `most_px`.
/// result  empty where the eye is at its target, or there is no room
[[nodiscard]] std::optional<DistanceBar> distance_bar(const Camera& camera, PixelSize size, double most_px,
                                                      const Unit& unit = Units{}.length());

/// What the bar and its words cover.
/// right, bottom  of that, pixels
[[nodiscard]] PixelRect distance_bar_place(const DistanceBar& bar, double right, double bottom, const Theme& theme);
/// The bar with its words above it: how long it is, and where that holds.
void add_distance_bar(FrameDescription& frame, const DistanceBar& bar, const PixelRect& place, const Theme& theme);

}  // namespace sonar
