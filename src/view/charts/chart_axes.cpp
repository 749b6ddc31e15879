// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_axes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/maps/map_items.h"
#include "view/shapes.h"
#include "view/timelines/timeline.h"

namespace sonar {
namespace {

constexpr double kMargin = 0.04;    ///< of the span, on each side
constexpr double kLargest = 1e5;    ///< that is written out
constexpr double kSmallest = 1e-2;  ///< the largest of an axis is at least this, or its ticks are in powers of ten
constexpr double kSecond_s = 1.0;

TimeNs time_of(double seconds) { return static_cast<TimeNs>(std::llround(seconds * 1e9)); }

int power_of(const ChartColumn& column, double low, double high) {
  const double most = std::max(std::abs(low), std::abs(high)) / column.unit_size;
  if (column.time || column.degrees || !(most > 0.0) || (most >= kSmallest && most < kLargest)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(most) / 3.0));
}

/// Half of an axis on which all values are equal.
double half_around(const ChartColumn& column, double value) {
  if (column.time) return 30.0 * kSecond_s;
  if (column.whole) return 1.0;
  if (column.unit.starts_with("degrees_")) return 0.001;
  return value == 0.0 ? 1.0 : 0.1 * std::abs(value);
}

double widest_px(std::span<const ChartTick> ticks, double em) {
  double widest = 0.0;
  for (const ChartTick& tick : ticks) widest = std::max(widest, text_width_px(tick.text.c_str(), em));
  return widest;
}

void add_x_ticks(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> ticks, const Theme& theme) {
  const double em = theme.text_px;
  const double bottom = plot.place.y + plot.place.height;
  for (const ChartTick& tick : ticks) {
    const double x = plot.at(tick.at, plot.y.first).x;
    frame.items.emplace_back(line_item({x, bottom}, {x, bottom + 0.4 * em}, theme.axis, theme.line_px));
    const double half = text_width_px(tick.text.c_str(), em) / 2.0;
    if (x - half < 0.0 || x + half > frame.size.width) continue;
    frame.items.emplace_back(text_item({x, bottom + 1.1 * em}, tick.text, em, theme.text, TextAnchor::centre));
  }
}

void add_y_ticks(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> ticks, const Theme& theme) {
  const double em = theme.text_px;
  for (const ChartTick& tick : ticks) {
    const double y = plot.at(plot.x.first, tick.at).y;
    frame.items.emplace_back(line_item({plot.place.x - 0.4 * em, y}, {plot.place.x, y}, theme.axis, theme.line_px));
    frame.items.emplace_back(text_item({plot.place.x - 0.6 * em, y}, tick.text, em, theme.text, TextAnchor::right));
  }
}

}  // namespace

ChartAxis chart_axis(const ChartColumn& column, std::span<const double> values, bool from_zero) {
  ChartAxis axis;
  axis.column = column;
  bool any = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    axis.low = any ? std::min(axis.low, value) : value;
    axis.high = any ? std::max(axis.high, value) : value;
    any = true;
  }
  if (!any) axis.high = axis.low + 1.0;
  if (from_zero) return part_of(axis, 0.0, std::max(1.0, (1.0 + kMargin) * axis.high));
  const double span = axis.high - axis.low;
  const bool one = !(span > 1e-9 * std::max(std::abs(axis.low), std::abs(axis.high)));
  const double more = one ? half_around(column, axis.low) : kMargin * span;
  return part_of(axis, axis.low - more, axis.high + more);
}

ChartAxis part_of(ChartAxis axis, double low, double high) {
  axis.low = low;
  axis.high = high;
  axis.power = power_of(axis.column, low, high);
  axis.label = axis_label(axis.column, axis.power);
  if (axis.column.time) axis.label += ", " + clock_text(time_of(low), true).substr(0, 10);
  return axis;
}

std::vector<ChartTick> chart_ticks(const ChartAxis& axis, int most) {
  std::vector<ChartTick> out;
  if (axis.column.time) {
    for (const TimeTick& tick : time_ticks(time_of(axis.low), time_of(axis.high), most)) {
      out.push_back({static_cast<double>(tick.time) / 1e9, tick.text});
    }
    return out;
  }
  const double unit = std::pow(10.0, axis.power) * axis.column.unit_size;
  const double low = axis.low / unit;
  const double high = axis.high / unit;
  Ticks ticks = axis.column.degrees ? degree_ticks(low, high, most) : nice_ticks(low, high, most);
  const bool halves = axis.column.whole && axis.power == 0 && ticks.decimals > 0;
  if (halves) ticks = step_ticks(std::ceil(low), std::floor(high), std::ceil(low), 1.0, most);
  if (halves && ticks.major.empty()) ticks.major.push_back(std::round(0.5 * (low + high)));
  for (const double value : ticks.major) {
    out.push_back(
        {value * unit, tick_text(value, halves ? 0 : ticks.decimals) + (axis.column.degrees ? "\u00B0" : "")});
  }
  return out;
}

std::vector<ChartTick> ticks_across(const ChartAxis& axis, double width_px, const Theme& theme) {
  const double em = theme.text_px;
  int most = std::max(2, static_cast<int>(width_px / (4.0 * em)));
  std::vector<ChartTick> ticks = chart_ticks(axis, most);
  const auto wanted = [&] { return (widest_px(ticks, em) + 1.2 * em) * static_cast<double>(ticks.size()); };
  while (most > 2 && wanted() > width_px) ticks = chart_ticks(axis, --most);
  return ticks;
}

std::vector<ChartTick> ticks_down(const ChartAxis& axis, double height_px, const Theme& theme) {
  int most = std::max(2, static_cast<int>(height_px / (3.2 * theme.text_px)));
  std::vector<ChartTick> ticks = chart_ticks(axis, most);
  // A scale with one number on it is none.
  while (ticks.size() < 2 && most < 6) ticks = chart_ticks(axis, ++most);
  return ticks;
}

void add_chart_grid(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> x,
                    std::span<const ChartTick> y, const Theme& theme) {
  PathItem grid;
  grid.stroke = {theme.grid, theme.line_px, {}};
  const PixelRect& r = plot.place;
  for (const ChartTick& tick : x) {
    const double at = plot.at(tick.at, plot.y.first).x;
    grid.parts.push_back({{{at, r.y}, {at, r.y + r.height}}, false});
  }
  for (const ChartTick& tick : y) {
    const double at = plot.at(plot.x.first, tick.at).y;
    grid.parts.push_back({{{r.x, at}, {r.x + r.width, at}}, false});
  }
  frame.items.emplace_back(std::move(grid));
}

void add_chart_axes(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> x,
                    std::span<const ChartTick> y, const Theme& theme) {
  const double em = theme.text_px;
  const PixelRect& r = plot.place;
  frame.items.emplace_back(rectangle_item(r, {0, 0, 0, 0}, theme.axis, theme.line_px));
  add_x_ticks(frame, plot, x, theme);
  add_y_ticks(frame, plot, y, theme);
  frame.items.emplace_back(text_item({r.x + r.width / 2.0, r.y + r.height + 2.5 * em},
                                     elided(plot.x.label, em, frame.size.width), em, theme.muted, TextAnchor::centre));
  TextItem label = text_item({r.x - widest_px(y, em) - 1.4 * em, r.y + r.height / 2.0},
                             elided(plot.y.label, em, std::max(r.height, frame.size.height - 2.0 * em)), em,
                             theme.muted, TextAnchor::centre);
  label.turned_deg = -90.0;
  frame.items.emplace_back(std::move(label));
}

}  // namespace sonar
