// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "view/frame_description.h"

namespace sonar {

/// A 2-D picture in memory, for whoever shows it. errors: as draw_frame()
/// scale  device pixels per pixel
[[nodiscard]] Result<Image> painted(const FrameDescription& frame, double scale);

}  // namespace sonar
