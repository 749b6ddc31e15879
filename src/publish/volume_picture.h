// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/work.h"
#include "model/depth_grid.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "render/volume_renderer.h"
#include "view/volume/context_scene.h"

namespace sonar {

/// A ping in three dimensions. Without raw files the masks alone are drawn, and the title says so.
/// errors  as DrawnObservation::ping(); bad_parameter; what the renderer or the depth raster refuse
[[nodiscard]] Result<FrameDescription> volume_frame(DrawnObservation& observation, const PictureOptions& options,
                                                    Work& work);

/// Depths round a ship on an even grid in the sonar frame, reach_m to each side.
/// errors  mismatch: nothing known there
[[nodiscard]] Result<SeabedPatch> seabed_patch(const DepthGrid& grid, const Placement& ship, double reach_m);

}  // namespace sonar
