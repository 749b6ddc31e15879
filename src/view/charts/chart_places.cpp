// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_places.h"

#include <algorithm>
#include <cmath>

namespace sonar {
namespace {

PixelRect between(PixelPoint a, PixelPoint b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::abs(a.x - b.x), std::abs(a.y - b.y)};
}

bool meet(const PixelRect& a, const PixelRect& b) {
  return a.x <= b.x + b.width && b.x <= a.x + a.width && a.y <= b.y + b.height && b.y <= a.y + a.height;
}

}  // namespace

std::vector<std::size_t> rows_within(const ChartPlaces& places, PixelPoint a, PixelPoint b) {
  const PixelRect rect = between(a, b);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < places.points.size(); ++i) {
    if (inside(rect, places.points[i])) rows.push_back(i);
  }
  for (const ChartPlaces::Bar& bar : places.bars) {
    if (meet(rect, bar.place)) rows.insert(rows.end(), bar.rows.begin(), bar.rows.end());
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::optional<std::size_t> row_at(const ChartPlaces& places, PixelPoint at) {
  std::optional<std::size_t> nearest;
  double best = places.reach_px;
  for (std::size_t i = 0; i < places.points.size(); ++i) {
    const double away = std::hypot(places.points[i].x - at.x, places.points[i].y - at.y);
    if (!(away <= best)) continue;
    best = away;
    nearest = i;
  }
  return nearest;
}

const ChartPlaces::Bar* bar_at(const ChartPlaces& places, PixelPoint at) {
  const auto found = std::find_if(places.bars.begin(), places.bars.end(),
                                  [&](const ChartPlaces::Bar& bar) { return inside(bar.place, at); });
  return found == places.bars.end() ? nullptr : &*found;
}

}  // namespace sonar
