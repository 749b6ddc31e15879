// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "view/axes.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// One thing that a picture's key explains.
struct KeyEntry {
  std::string text;
  std::function<void(FrameDescription& frame, const PixelRect& swatch)> draw;  ///< empty = its room is left free
};

/// Lines that the entries take, side by side; none for none.
[[nodiscard]] int key_lines(std::span<const KeyEntry> entries, double width_px, const Theme& theme);
/// The entries in a place of that many lines, kFootLine_em high; words that are wider than a line are shortened.
void add_key(FrameDescription& frame, const PixelRect& place, std::span<const KeyEntry> entries, const Theme& theme);

}  // namespace sonar
