// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// What became of an observation's schools.
/// errors  not_found: no schools; usage: a school that the observation has not
[[nodiscard]] Result<FrameDescription> lineage_frame(const DrawnObservation& observation,
                                                     const PictureOptions& options);

}  // namespace sonar
