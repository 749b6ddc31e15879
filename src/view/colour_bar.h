// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "view/axes.h"
#include "view/colour_map.h"
#include "view/frame_description.h"
#include "view/sv_scale.h"
#include "view/theme.h"

namespace sonar {

inline constexpr const char* kSvLabel = "Sv (dB re 1 m\u207B\u00B9)";

/// Upright bar in `place`, ticks and labels at its right, the label along them. Both display limits are labelled (bold) and the
/// analysis threshold, where there is one, is marked as a thing of its own.
void add_colour_bar(FrameDescription& frame, const PixelRect& place, const SvColours& colours, const Theme& theme,
                    const std::string& label = kSvLabel);

/// The same for any quantity and map: depth, time. `rising_down`: low at the top, as depth is read.
void add_colour_bar(FrameDescription& frame, const PixelRect& place, const ColourMap& map, double low, double high,
                    const Theme& theme, const std::string& label, bool rising_down = false);

}  // namespace sonar
