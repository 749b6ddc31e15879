// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include "view/frame_description.h"

namespace sonar {

/// What the pixels of a target allow.
struct FrameTarget {
  double scale = 1.0;   ///< target's units per unit of the description
  bool vector = false;  ///< SVG, PDF: small images become rectangles, nothing is moved onto whole pixels
};

/// Draws background and items. Items with a coordinate that is not finite, or an image without pixels, are left out.
void draw_items(cairo_t* context, const FrameDescription& frame, const FrameTarget& target);

/// One line of text in DejaVu Sans.
void draw_text(cairo_t* context, const TextItem& item);

}  // namespace sonar
