// SPDX-License-Identifier: Apache-2.0
#include "view/maps/scale_bars.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastMap_em = 10.0;
constexpr double kArrowFrom_rad = 0.0174532925;

ScaleBars bars_at(const MapFrame& map, const Theme& theme, PixelPoint corner) {
  const double em = theme.text_px;
  const double most_px = std::min(14.0 * em, 0.3 * map.place.width);
  const PixelPoint upper{corner.x + 0.6 * em, corner.y + 0.9 * em};
  ScaleBars made{{scale_bar(map, upper, most_px, true, theme.units),
                  scale_bar(map, {upper.x, upper.y + 0.9 * em}, most_px, false, theme.units)},
                 {}};
  const double longest = std::max(made.bars[0].to.x, made.bars[1].to.x) - upper.x;
  made.place = {corner.x, corner.y, longest + 5.4 * em, 2.7 * em};
  return made;
}

std::ptrdiff_t count_inside(const PixelRect& place, double margin, std::span<const PixelPoint> points) {
  const PixelRect wide{place.x - margin, place.y - margin, place.width + 2.0 * margin, place.height + 2.0 * margin};
  return std::count_if(points.begin(), points.end(), [&](const PixelPoint& at) { return inside(wide, at); });
}

}  // namespace

ScaleBar scale_bar(const MapFrame& map, PixelPoint left, double most_px, bool nautical, const Units& units) {
  const Geographic middle = map.geographic({left.x + most_px / 2.0, left.y}).value_or(Geographic{});
  const double metres_per_px = map.true_metres_per_px(middle);
  Unit unit = nautical ? Unit{kMetresPerNauticalMile, "nmi"} : Unit{1000.0, "km"};
  const double most_m = most_px * metres_per_px;
  if (!nautical && most_m < 1000.0) unit = units.length();
  ScaleBar bar;
  bar.length_m = round_below(most_m, unit);
  bar.from = left;
  bar.to = {left.x + bar.length_m / metres_per_px, left.y};
  bar.text = round_text(bar.length_m, unit);
  return bar;
}

std::optional<ScaleBars> scale_bars(const MapFrame& map, const Theme& theme, std::span<const PixelPoint> symbols,
                                    std::span<const PixelPoint> else_shown) {
  const double em = theme.text_px;
  if (map.place.height < kLeastMap_em * em) return std::nullopt;
  const double gap = 0.6 * em;
  const PixelRect& r = map.place;
  const double low = r.y + r.height - 2.9 * em;
  const double right = r.x + r.width - gap - bars_at(map, theme, {r.x + gap, low}).place.width;
  std::optional<ScaleBars> best;
  std::pair<std::ptrdiff_t, std::ptrdiff_t> least;
  // The upper right corner is the arrow's.
  for (const PixelPoint corner : {PixelPoint{r.x + gap, low}, {right, low}, {r.x + gap, r.y + gap}}) {
    ScaleBars bars = bars_at(map, theme, corner);
    // Another place of the map may have a longer round length.
    const double over = bars.place.x + bars.place.width - (r.x + r.width - gap);
    if (over > 0.0) bars = bars_at(map, theme, {corner.x - over, corner.y});
    // A symbol is up to twice as long as the text is high.
    const std::pair hides(count_inside(bars.place, em, symbols), count_inside(bars.place, 0.0, else_shown));
    if (best && hides >= least) continue;
    least = hides;
    best = std::move(bars);
  }
  return best;
}

void add_scale_bars(FrameDescription& frame, const ScaleBars& bars, const Theme& theme) {
  const double em = theme.text_px;
  frame.items.emplace_back(rectangle_item(bars.place, theme.halo, theme.grid, theme.line_px));
  for (const ScaleBar& bar : bars.bars) {
    const double tick = 0.3 * em;
    PathItem path = polyline_item({{bar.from.x, bar.from.y - tick}, bar.from, bar.to, {bar.to.x, bar.to.y - tick}},
                                  false, theme.text, 1.5 * theme.line_px);
    frame.items.emplace_back(std::move(path));
    frame.items.emplace_back(
        text_item({bar.to.x + 0.4 * em, bar.to.y - 0.1 * em}, bar.text, small_text_px(theme, 0.9), theme.text));
  }
}

void add_north(FrameDescription& frame, const MapFrame& map, const Theme& theme) {
  const double em = theme.text_px;
  double most_rad = 0.0;
  for (const double u : {0.02, 0.98}) {
    for (const double v : {0.02, 0.98}) {
      const auto p = map.geographic({map.place.x + u * map.place.width, map.place.y + v * map.place.height});
      if (p) most_rad = std::max(most_rad, std::abs(map.projection.north_rad(*p)));
    }
  }
  if (most_rad <= kArrowFrom_rad) return;
  const PixelPoint at{map.place.x + map.place.width - 2.2 * em, map.place.y + 2.8 * em};
  const auto here = map.geographic(at);
  if (!here) return;
  add_north_arrow(frame, at, 3.0 * em, map.projection.north_rad(*here), theme.text, theme.halo, em);
}

}  // namespace sonar
