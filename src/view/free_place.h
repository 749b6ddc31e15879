// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "view/frame_description.h"

namespace sonar {

/// What nothing may be drawn over: the corners of a convex shape, in order.
using ConvexOutline = std::vector<PixelPoint>;

/// Corners of a rectangle.
[[nodiscard]] ConvexOutline outline_of(const PixelRect& rect);
/// Whether a rectangle and a convex shape have area in common (by the theorem of separating axes).
[[nodiscard]] bool covers(const PixelRect& rect, const ConvexOutline& shape);

/// Corners of a picture, where a box of words stands where it has the choice.
enum class Corner : std::uint8_t { lower_left, lower_right };

/// A place for a box along the edges of `inside` that covers none of `kept_clear`: the nearest one to the corner.
/// result  empty where the box is too large, or something lies at all of them
[[nodiscard]] std::optional<PixelRect> free_place(const PixelRect& inside, double width, double height, Corner corner,
                                                  std::span<const ConvexOutline> kept_clear);

}  // namespace sonar
