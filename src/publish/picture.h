// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/frame_description.h"

namespace sonar {

/// Any kind of picture from a source.
/// observation  name; empty = the first, and of a chart all; what shows the whole survey passes it over
/// errors       one line each: what the source lacks for it, or which option is out of range
[[nodiscard]] Result<FrameDescription> picture_frame(PictureKind kind, PictureSource& source,
                                                     const std::string& observation, const PictureOptions& options,
                                                     Work& work);

/// Where what is made of all observations is from.
[[nodiscard]] PictureOrigin survey_origin(PictureSource& source);

}  // namespace sonar
