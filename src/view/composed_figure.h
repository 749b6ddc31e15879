// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/frame_description.h"

namespace sonar {

/// Where a picture lies in a rectangle: as large as it goes without being distorted, in the middle.
[[nodiscard]] PixelRect fitted(PixelSize picture, const PixelRect& place);

/// Adds a picture to a page, scaled to fitted(picture.size, place): places, text, lines and dashes alike. Nothing of it
/// leaves the rectangle, and what it clips stays clipped. The page's own clipping ends before it.
void place_frame(FrameDescription& page, const FrameDescription& picture, const PixelRect& place);

}  // namespace sonar
