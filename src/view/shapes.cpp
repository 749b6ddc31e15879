// SPDX-License-Identifier: Apache-2.0
#include "view/shapes.h"

#include <cmath>
#include <utility>

namespace sonar {
namespace {

/// `p` in units of `scale`, turned clockwise as seen, moved to `at`.
PixelPoint placed(PixelPoint p, PixelPoint at, double scale, double turned_rad) {
  const double c = std::cos(turned_rad);
  const double s = std::sin(turned_rad);
  return {at.x + scale * (p.x * c - p.y * s), at.y + scale * (p.x * s + p.y * c)};
}

}  // namespace

PathItem line_item(PixelPoint a, PixelPoint b, Rgba8 colour, double width_px) {
  return polyline_item({a, b}, false, colour, width_px);
}

PathItem polyline_item(std::vector<PixelPoint> points, bool closed, Rgba8 colour, double width_px, Rgba8 fill) {
  PathItem item;
  item.parts.push_back({std::move(points), closed});
  item.fill = fill;
  item.stroke = {colour, width_px, {}};
  return item;
}

PathItem rectangle_item(const PixelRect& r, Rgba8 fill, Rgba8 stroke, double width_px) {
  return polyline_item({{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}}, true,
                       stroke, width_px, fill);
}

TextItem text_item(PixelPoint at, std::string text, double size_px, Rgba8 colour, TextAnchor anchor) {
  TextItem item;
  item.at = at;
  item.text = std::move(text);
  item.size_px = size_px;
  item.colour = colour;
  item.anchor = anchor;
  return item;
}

PathItem ship_item(PixelPoint at, double length_px, double turned_rad, Rgba8 fill, Rgba8 edge, double edge_px) {
  std::vector<PixelPoint> hull;
  for (const PixelPoint p : {PixelPoint{0.0, -0.5},
                             {0.11, -0.34},
                             {0.17, -0.14},
                             {0.17, 0.42},
                             {0.13, 0.5},
                             {-0.13, 0.5},
                             {-0.17, 0.42},
                             {-0.17, -0.14},
                             {-0.11, -0.34}}) {
    hull.push_back(placed(p, at, length_px, turned_rad));
  }
  return polyline_item(std::move(hull), true, edge, edge_px, fill);
}

void add_north_arrow(FrameDescription& frame, PixelPoint centre, double length_px, double turned_rad, Rgba8 colour,
                     Rgba8 halo, double text_px) {
  std::vector<PixelPoint> arrow;
  for (const PixelPoint p : {PixelPoint{0.0, -0.5}, {0.2, 0.5}, {0.0, 0.3}, {-0.2, 0.5}}) {
    arrow.push_back(placed(p, centre, length_px, turned_rad));
  }
  frame.items.emplace_back(polyline_item(std::move(arrow), true, halo, 1.0, colour));
  const PixelPoint letter = placed({0.0, -0.5}, centre, length_px + 1.5 * text_px, turned_rad);
  TextItem n = text_item(letter, "N", text_px, colour, TextAnchor::centre);
  n.bold = true;
  n.halo = halo;
  frame.items.emplace_back(std::move(n));
}

}  // namespace sonar
