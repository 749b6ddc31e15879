// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// One of the four slice kinds. Without raw files the masks alone are drawn, and the title says so.
/// errors  as DrawnObservation::ping() and slice_picture(); usage: a slice that the sector has not
[[nodiscard]] Result<FrameDescription> slice_frame(PictureKind kind, DrawnObservation& observation,
                                                   const PictureOptions& options, Work& work);

}  // namespace sonar
