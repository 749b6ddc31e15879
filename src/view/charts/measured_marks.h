// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "view/axes.h"
#include "view/frame_description.h"
#include "view/key_rows.h"
#include "view/shapes.h"
#include "view/theme.h"

namespace sonar {

/// A measured value in a chart, with its standard error; 0 or unknown = no bar.
struct Measured {
  double x = 0.0;
  double y = 0.0;
  double se = 0.0;
};
struct MarkLook {
  Rgba8 colour;
  bool filled = true;
};

[[nodiscard]] inline PathItem mark_item(PixelPoint at, double radius_px, const MarkLook& look, const Theme& theme) {
  constexpr int kCorners = 16;
  constexpr double kTurn = 6.283185307179586;
  std::vector<PixelPoint> ring;
  for (int i = 0; i < kCorners; ++i) {
    ring.push_back(
        {at.x + radius_px * std::cos(kTurn * i / kCorners), at.y + radius_px * std::sin(kTurn * i / kCorners)});
  }
  return polyline_item(std::move(ring), true, look.colour, 1.2 * theme.line_px, look.filled ? look.colour : theme.plot);
}

/// A disc or a ring, and a bar from one standard error below to one above.
inline void add_measured(FrameDescription& frame, const PlotFrame& plot, const Measured& one, const MarkLook& look,
                         const Theme& theme) {
  const double half = 0.2 * theme.text_px;
  if (one.se > 0.0) {
    const PixelPoint low = plot.at(one.x, one.y - one.se);
    const PixelPoint high = plot.at(one.x, one.y + one.se);
    PathItem bar = line_item(low, high, look.colour, theme.line_px);
    for (const PixelPoint& end : {low, high}) {
      bar.parts.push_back({{{end.x - half, end.y}, {end.x + half, end.y}}, false});
    }
    frame.items.emplace_back(std::move(bar));
  }
  frame.items.emplace_back(mark_item(plot.at(one.x, one.y), 0.24 * theme.text_px, look, theme));
}

[[nodiscard]] inline KeyEntry mark_entry(std::string text, const MarkLook& look, const Theme& theme) {
  return {std::move(text), [look, &theme](FrameDescription& frame, const PixelRect& swatch) {
            const PixelPoint middle{swatch.x + 0.5 * swatch.width, swatch.y + 0.5 * swatch.height};
            frame.items.emplace_back(mark_item(middle, 0.24 * theme.text_px, look, theme));
          }};
}

/// Where y is 0.
inline void add_zero_line(FrameDescription& frame, const PlotFrame& plot, const Theme& theme) {
  const double y = plot.at(plot.x.first, 0.0).y;
  frame.items.emplace_back(
      line_item({plot.place.x, y}, {plot.place.x + plot.place.width, y}, theme.axis, theme.line_px));
}

}  // namespace sonar
