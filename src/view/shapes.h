// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "view/frame_description.h"

namespace sonar {

/// Plain shapes as items of a frame.
[[nodiscard]] PathItem line_item(PixelPoint a, PixelPoint b, Rgba8 colour, double width_px);
[[nodiscard]] PathItem polyline_item(std::vector<PixelPoint> points, bool closed, Rgba8 colour, double width_px,
                                     Rgba8 fill = {0, 0, 0, 0});
[[nodiscard]] PathItem rectangle_item(const PixelRect& r, Rgba8 fill, Rgba8 stroke = {0, 0, 0, 0},
                                      double width_px = 0.0);
[[nodiscard]] TextItem text_item(PixelPoint at, std::string text, double size_px, Rgba8 colour,
                                 TextAnchor anchor = TextAnchor::left);

/// A ship seen from above, bow up before it is turned; `length_px` from bow to stern.
[[nodiscard]] PathItem ship_item(PixelPoint at, double length_px, double turned_rad, Rgba8 fill, Rgba8 edge,
                                 double edge_px);

/// An arrow to north with its letter; `turned_rad` clockwise from up.
void add_north_arrow(FrameDescription& frame, PixelPoint centre, double length_px, double turned_rad, Rgba8 colour,
                     Rgba8 halo, double text_px);

}  // namespace sonar
