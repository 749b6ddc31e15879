// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "view/volume/propagation_view.h"

namespace sonar {

/// Ping and, where there is room, time above a panel, the last line nearest to it.
void add_ping_label(FrameDescription& frame, const PropagationPanel& panel, const PropagationStyle& style, bool timed,
                    const PixelRect& place, const Theme& theme);

/// Depths below the sea surface along a panel's left edge, and the surface where it is seen.
/// middle_m  depth at the panel's middle
void add_depth_scale(FrameDescription& frame, double middle_m, double px_per_m, const PixelRect& place,
                     const Theme& theme);

/// A school's number in a panel, and what its mask covers there.
struct PanelNumber {
  std::string text;
  PixelRect mask;
};
/// Numbers beside their masks, to the right first: none on another school or another number where there is a choice.
void add_panel_numbers(FrameDescription& frame, std::span<const PanelNumber> numbers, const PixelRect& place,
                       const Theme& theme);

/// Along a panel's lower edge, on as many lines as it takes.
void add_panel_note(FrameDescription& frame, const std::string& note, const PixelRect& place, const Theme& theme);

}  // namespace sonar
