// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "view/axes.h"
#include "view/slice_picture.h"

namespace sonar {

/// A faded sample's colour.
[[nodiscard]] Rgba8 faded_colour(Rgba8 colour, const Theme& theme);
/// Whether a stripe of the hatch runs through a pixel.
[[nodiscard]] bool on_hatch(int x, int y, const Theme& theme);

/// One thing that a slice's key explains.
struct SliceKeyEntry {
  enum class Look : std::uint8_t { hatched, faded, hidden, outline };
  Look look = Look::hidden;
  std::string text;
  Rgba8 colour{};  ///< of an outline
  OutlineLine line = OutlineLine::solid;
};
/// What the style's key has to explain, in order; none without a key, and for a slice that is plain and without schools.
[[nodiscard]] std::vector<SliceKeyEntry> slice_key(const SliceStyle& style);

/// Lines that the entries take, side by side; an entry that is wider than a line is shortened.
[[nodiscard]] int slice_key_lines(const std::vector<SliceKeyEntry>& entries, double width_px, const Theme& theme);
/// The entries in a place of that many lines.
void add_slice_key(FrameDescription& frame, const PixelRect& place, const std::vector<SliceKeyEntry>& entries,
                   const SvColours& colours, const Theme& theme);

}  // namespace sonar
