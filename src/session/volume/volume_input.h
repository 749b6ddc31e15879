// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "publish/volumes/live_volume.h"
#include "session/looks/picture_look.h"
#include "session/open/workspace.h"

namespace sonar {

/// What the view in three dimensions shows of a workspace: the ping that has arrived, the schools in it, what is being tried
/// and carried through time, and all parameters. Empty where no ping has arrived.
/// camera  empty = the overview
/// look    size in the window's units, or 1/96 inch of a page; a panel's text and lines in these too
/// cost    no samples are touched
[[nodiscard]] std::optional<LiveVolumeInput> volume_input(const Workspace& workspace,
                                                          const std::optional<Camera>& camera, const PictureLook& look);

}  // namespace sonar
