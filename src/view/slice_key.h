// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "view/key_rows.h"
#include "view/slice_picture.h"

namespace sonar {

/// A faded sample's colour.
[[nodiscard]] Rgba8 faded_colour(Rgba8 colour, const Theme& theme);
/// Whether a stripe of the hatch runs through a pixel.
[[nodiscard]] bool on_hatch(int x, int y, const Theme& theme);

/// What the style's key has to explain, in order; none without a key, and for a slice that is plain and without schools.
[[nodiscard]] std::vector<KeyEntry> slice_key(const SliceStyle& style, const Theme& theme);

}  // namespace sonar
