// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "view/frame_description.h"

namespace sonar {

/// Cairo writes letters as outlines, so that a picture looks alike wherever it is opened. Here the same words lie over
/// them as text that is not seen: they can be found, marked and copied, and a screen reader reads them.
/// svg    of the frame
/// scale  of the frame's pixels
[[nodiscard]] std::string searchable_svg(const std::string& svg, const FrameDescription& frame, double scale);

}  // namespace sonar
