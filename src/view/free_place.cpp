// SPDX-License-Identifier: Apache-2.0
#include "view/free_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

/// Whether a line along the shape's side from a to b has all of the rectangle beyond it.
bool apart(PixelPoint a, PixelPoint b, PixelPoint within, const ConvexOutline& corners) {
  const auto side = [&](PixelPoint p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  const double own = side(within);
  return own != 0.0 && std::all_of(corners.begin(), corners.end(), [&](PixelPoint p) { return side(p) * own <= 0.0; });
}

PixelPoint middle_of(const ConvexOutline& shape) {
  PixelPoint out{0.0, 0.0};
  for (const PixelPoint& p : shape) {
    out.x += p.x / static_cast<double>(shape.size());
    out.y += p.y / static_cast<double>(shape.size());
  }
  return out;
}

}  // namespace

ConvexOutline outline_of(const PixelRect& r) {
  return {{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}};
}

bool covers(const PixelRect& rect, const ConvexOutline& shape) {
  if (shape.empty()) return false;
  const auto [left, right] =
      std::minmax_element(shape.begin(), shape.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [top, bottom] =
      std::minmax_element(shape.begin(), shape.end(), [](auto& a, auto& b) { return a.y < b.y; });
  if (left->x >= rect.x + rect.width || right->x <= rect.x) return false;
  if (top->y >= rect.y + rect.height || bottom->y <= rect.y) return false;
  const ConvexOutline corners = outline_of(rect);
  const PixelPoint within = middle_of(shape);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (apart(shape[i], shape[(i + 1) % shape.size()], within, corners)) return false;
  }
  return true;
}

std::optional<PixelRect> free_place(const PixelRect& inside, double width, double height, Corner corner,
                                    std::span<const ConvexOutline> kept_clear) {
  constexpr int kSteps = 24;
  const double across = inside.width - width;
  const double down = inside.height - height;
  if (across < 0.0 || down < 0.0) return std::nullopt;
  std::optional<PixelRect> best;
  double nearest = 0.0;
  for (int iy = 0; iy <= kSteps; ++iy) {
    for (int ix = 0; ix <= kSteps; ++ix) {
      if (ix != 0 && ix != kSteps && iy != 0 && iy != kSteps) continue;  // not at an edge
      const double from_left = across * ix / kSteps;
      const double from_bottom = down * iy / kSteps;
      const double away = std::hypot(corner == Corner::lower_left ? from_left : across - from_left, from_bottom);
      if (best && away >= nearest) continue;
      const PixelRect rect{inside.x + from_left, inside.y + down - from_bottom, width, height};
      const auto taken = [&](const ConvexOutline& shape) { return covers(rect, shape); };
      if (std::any_of(kept_clear.begin(), kept_clear.end(), taken)) continue;
      best = rect;
      nearest = away;
    }
  }
  return best;
}

}  // namespace sonar
