// SPDX-License-Identifier: Apache-2.0
#include "publish/painted.h"

#include "render/draw_frame.h"

namespace sonar {

Result<Image> painted(const FrameDescription& frame, double scale) { return draw_frame(frame, scale); }

}  // namespace sonar
