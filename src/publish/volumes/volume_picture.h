// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "render/volume_renderer.h"
#include "view/volume/context_scene.h"

namespace sonar {

/// The options with a ping at which there is something to see. Where none is asked for and no school is known, a picture of
/// surfaces is of fullest_ping(): another may have none.
/// errors  as require_schools() and observation_echogram()
/// cost    the observation's echogram, where that is not kept from before
[[nodiscard]] Result<PictureOptions> with_ping_to_see(DrawnObservation& observation, PictureOptions options,
                                                      Work& work);

/// A ping in three dimensions. Without raw files the masks alone are drawn, and the title says so.
/// errors  as DrawnObservation::ping(); usage, mismatch: of the ping in which an earth-fixed eye stands; bad_parameter; what the renderer or the depth raster refuse
[[nodiscard]] Result<FrameDescription> volume_frame(DrawnObservation& observation, const PictureOptions& options,
                                                    Work& work);

}  // namespace sonar
