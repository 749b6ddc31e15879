// SPDX-License-Identifier: Apache-2.0
#include "view/free_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

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

/// Where boxes along an edge begin that cover a shape: between these, neither among them.
struct Taken {
  double first = 0.0;
  double last = 0.0;
};

/// Boxes that stand on one edge of a picture, and begin anywhere along it between `first` and `last`.
struct Edge {
  bool level = true;  ///< the picture's upper or lower edge
  double first = 0.0;
  double last = 0.0;
  double length = 0.0;  ///< of a box, along the edge
  double near = 0.0;    ///< where boxes begin and end across it
  double far = 0.0;

  [[nodiscard]] double along(PixelPoint p) const { return level ? p.x : p.y; }
  [[nodiscard]] double across(PixelPoint p) const { return level ? p.y : p.x; }
};

/// Empty where the shape lies beside the strip that the boxes lie in.
std::optional<Taken> taken_by(const ConvexOutline& shape, const Edge& edge) {
  const auto is_before = [&](const PixelPoint& p) { return edge.across(p) <= edge.near; };
  const auto is_beyond = [&](const PixelPoint& p) { return edge.across(p) >= edge.far; };
  if (std::ranges::all_of(shape, is_before) || std::ranges::all_of(shape, is_beyond)) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  const auto reach = [&](double at) {
    least = std::min(least, at);
    most = std::max(most, at);
  };
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const PixelPoint a = shape[i];
    const PixelPoint b = shape[(i + 1) % shape.size()];
    if (edge.across(a) >= edge.near && edge.across(a) <= edge.far) reach(edge.along(a));
    for (const double border : {edge.near, edge.far}) {
      if ((edge.across(a) < border) == (edge.across(b) < border)) continue;
      const double share = (border - edge.across(a)) / (edge.across(b) - edge.across(a));
      reach(edge.along(a) + share * (edge.along(b) - edge.along(a)));
    }
  }
  return Taken{least - edge.length, most};
}

/// Where free boxes may begin: the ends of each stretch that no shape takes.
std::vector<double> free_starts(const Edge& edge, std::span<const ConvexOutline> kept_clear) {
  std::vector<Taken> taken;
  std::vector<double> starts{edge.first, edge.last};
  for (const ConvexOutline& shape : kept_clear) {
    const auto by = taken_by(shape, edge);
    if (!by) continue;
    taken.push_back(*by);
    starts.insert(starts.end(), {by->first, by->last});
  }
  std::erase_if(starts, [&](double start) {
    const auto covered = [&](const Taken& t) { return start > t.first && start < t.last; };
    return start < edge.first || start > edge.last || std::ranges::any_of(taken, covered);
  });
  return starts;
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

// Whatever room there is beside one convex shape reaches an edge, and one of the picture's corners.
std::optional<PixelRect> free_place(const PixelRect& inside, double width, double height, Corner corner,
                                    std::span<const ConvexOutline> kept_clear) {
  if (inside.width < width || inside.height < height) return std::nullopt;
  const double right = inside.x + inside.width - width;
  const double bottom = inside.y + inside.height - height;
  const PixelPoint wanted{corner == Corner::lower_left ? inside.x : right, bottom};
  std::optional<PixelRect> best;
  double nearest = 0.0;
  const auto offer = [&](double x, double y) {
    const double away = std::hypot(x - wanted.x, y - wanted.y);
    if (best && away >= nearest) return;
    best = PixelRect{x, y, width, height};
    nearest = away;
  };
  for (const double y : {bottom, inside.y}) {
    for (const double x : free_starts({true, inside.x, right, width, y, y + height}, kept_clear)) offer(x, y);
  }
  for (const double x : {inside.x, right}) {
    for (const double y : free_starts({false, inside.y, bottom, height, x, x + width}, kept_clear)) offer(x, y);
  }
  return best;
}

}  // namespace sonar
