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

[[nodiscard]] ColourBar colour_bar(const SvColours& colours, std::string label = kSvLabel);
/// Of any quantity and map: depth, time.
[[nodiscard]] ColourBar colour_bar(const ColourMap& map, double low, double high, std::string label,
                                   bool rising_down = false);

/// Upright bar in `place`, ticks and labels at its right, the label along them. Both display limits are labelled (bold) and the
/// analysis threshold, where there is one, is marked as a thing of its own. Where the theme leaves bars to the page, it goes
/// into the frame's `bars` instead.
void add_colour_bar(FrameDescription& frame, const PixelRect& place, ColourBar bar, const Theme& theme);

/// The same lying, low at the left: ticks and labels below it, and the label below them.
void add_level_colour_bar(FrameDescription& frame, const PixelRect& place, const ColourBar& bar, const Theme& theme);

/// Room that a lying bar needs below itself, in em: ticks, labels, the label.
inline constexpr double kBelowLevelBar_em = 3.3;

}  // namespace sonar
