// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/open/workspace.h"
#include "view/theme.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// A school's colour in every view: its own, or grey where it was rejected.
[[nodiscard]] Rgba8 drawn_colour(const StateSchool& school, const Theme& theme);
/// What would be selected: in a colour that no school and no Sv has.
[[nodiscard]] Rgba8 preview_colour();

/// A mask to be drawn, and what is said of it.
struct SchoolLayer {
  std::int64_t number = 0;  ///< of the school; 0 = the preview, or a propagation that runs
  bool selected = false;
  MaskLayer layer;
  std::string title = {};     ///< "school 3 (north wall)"
  bool casts_shadow = false;  ///< it takes sound out of beams: a school that no human rejected
};

/// A mask in a colour, its outline drawn as that of schools of this status.
[[nodiscard]] MaskLayer mask_layer(std::shared_ptr<const PingMask> mask, Rgba8 colour, const std::string& status);

/// What lies over a ping of the observation on show: its schools, what a running propagation has reached, and what would
/// be selected, the last on top. Nothing where masks are switched off, but what would be selected.
[[nodiscard]] std::vector<SchoolLayer> school_layers(const Workspace& workspace, std::int64_t ping_index,
                                                     const Theme& theme);

/// A mask without the voxels of so little confidence.
/// fuzzy_above  0..1; those above it stay
[[nodiscard]] std::shared_ptr<const PingMask> fuzzy_area(std::shared_ptr<const PingMask> mask, double fuzzy_above);

}  // namespace sonar
