// SPDX-License-Identifier: Apache-2.0
#include "view/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "view/shapes.h"

namespace sonar {
namespace {

struct Step {
  double size = 1.0;
  int parts = 5;  ///< minor intervals in one
  int decimals = 0;
};

/// Whole multiples of `step` in [low, high], ends included up to rounding.
std::vector<double> multiples(double low, double high, double step) {
  const double slack = 1e-9;
  const auto first = static_cast<std::int64_t>(std::ceil(low / step - slack));
  const auto last = static_cast<std::int64_t>(std::floor(high / step + slack));
  std::vector<double> out;
  for (std::int64_t i = first; i <= last; ++i) out.push_back(static_cast<double>(i) * step);
  return out;
}

double multiples_count(double low, double high, double step) {
  return std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1.0;
}

bool usable(double low, double high) {
  return std::isfinite(low) && std::isfinite(high) &&
         high - low > 1e-12 * std::max({1e-290, std::abs(low), std::abs(high)});
}

Step decimal_step(double low, double high, int most) {
  const double rough = (high - low) / most;
  int power = static_cast<int>(std::floor(std::log10(rough))) - 1;
  for (;; ++power) {
    for (const auto& [factor, parts] : {std::pair{1, 5}, std::pair{2, 4}, std::pair{5, 5}}) {
      // A quotient of whole numbers where the step is below 1: 3 * 0.1 would not be 0.3.
      const double size = power >= 0 ? factor * std::pow(10.0, power) : factor / std::pow(10.0, -power);
      if (multiples_count(low, high, size) <= most) return {size, parts, std::max(0, -power)};
    }
  }
}

Ticks ticks_of(double low, double high, const Step& step) {
  Ticks out;
  out.step = step.size;
  out.decimals = step.decimals;
  out.major = multiples(low, high, step.size);
  const double minor = step.size / step.parts;
  for (const double value : multiples(low, high, minor)) {
    const double turns = value / step.size;
    if (std::abs(turns - std::round(turns)) > 0.25 / step.parts) out.minor.push_back(value);
  }
  return out;
}

struct TickLengths {
  double major;
  double minor;
};

TickLengths tick_lengths(const Theme& theme) { return {0.45 * theme.text_px, 0.25 * theme.text_px}; }

Ticks axis_ticks(const PlotAxis& axis, int most) {
  return axis.degrees ? degree_ticks(axis.first, axis.last, most) : nice_ticks(axis.first, axis.last, most);
}

void add_grid(FrameDescription& frame, const PlotFrame& plot, const Theme& theme, const Ticks& x, const Ticks& y) {
  PathItem grid;
  grid.stroke = {theme.grid, theme.line_px, {}};
  const PixelRect& r = plot.place;
  for (const double v : x.major) {
    const double px = plot.at(v, plot.y.first).x;
    grid.parts.push_back({{{px, r.y}, {px, r.y + r.height}}, false});
  }
  for (const double v : y.major) {
    const double py = plot.at(plot.x.first, v).y;
    grid.parts.push_back({{{r.x, py}, {r.x + r.width, py}}, false});
  }
  frame.items.emplace_back(std::move(grid));
}

void add_tick_marks(PathItem& marks, const PlotFrame& plot, const std::vector<double>& values, bool along_x,
                    double length) {
  for (const double v : values) {
    if (along_x) {
      const double px = plot.at(v, plot.y.first).x;
      const double base = plot.place.y + plot.place.height;
      marks.parts.push_back({{{px, base}, {px, base + length}}, false});
    } else {
      const double py = plot.at(plot.x.first, v).y;
      marks.parts.push_back({{{plot.place.x - length, py}, {plot.place.x, py}}, false});
    }
  }
}

/// A tick's number as an axis says it.
std::string number_text(const PlotAxis& axis, double value, int decimals) {
  return tick_text(axis.both_ways ? std::abs(value) : value, decimals) + (axis.degrees ? "\u00B0" : "");
}

void add_x_texts(FrameDescription& frame, const PlotFrame& plot, const Theme& theme, const Ticks& ticks) {
  const double base = plot.place.y + plot.place.height + tick_lengths(theme).major;
  for (const double v : ticks.major) {
    frame.items.emplace_back(text_item({plot.at(v, plot.y.first).x, base + 0.75 * theme.text_px},
                                       number_text(plot.x, v, ticks.decimals), theme.text_px, theme.text,
                                       TextAnchor::centre));
  }
  frame.items.emplace_back(text_item({plot.place.x + plot.place.width / 2, base + 2.15 * theme.text_px}, plot.x.label,
                                     theme.text_px, theme.muted, TextAnchor::centre));
}

void add_y_texts(FrameDescription& frame, const PlotFrame& plot, const Theme& theme, const Ticks& ticks) {
  const double base = plot.place.x - tick_lengths(theme).major - 0.3 * theme.text_px;
  double widest = 0.0;
  for (const double v : ticks.major) {
    const std::string text = number_text(plot.y, v, ticks.decimals);
    widest = std::max(widest, text_width_px(text.c_str(), theme.text_px));
    frame.items.emplace_back(
        text_item({base, plot.at(plot.x.first, v).y}, text, theme.text_px, theme.text, TextAnchor::right));
  }
  TextItem label = text_item({base - widest - 0.9 * theme.text_px, plot.place.y + plot.place.height / 2}, plot.y.label,
                             theme.text_px, theme.muted, TextAnchor::centre);
  label.turned_deg = -90.0;
  frame.items.emplace_back(std::move(label));
}

}  // namespace

Ticks nice_ticks(double low, double high, int most) {
  if (low > high) std::swap(low, high);
  if (!usable(low, high) || most < 1) return {};
  return ticks_of(low, high, decimal_step(low, high, most));
}

Ticks degree_ticks(double low, double high, int most) {
  static constexpr std::array<Step, 8> kSteps = {
      {{1, 5, 0}, {2, 4, 0}, {5, 5, 0}, {10, 5, 0}, {15, 3, 0}, {30, 3, 0}, {45, 3, 0}, {90, 3, 0}}};
  if (low > high) std::swap(low, high);
  if (!usable(low, high) || most < 1) return {};
  const Step decimal = decimal_step(low, high, most);
  if (decimal.size < 1.0) return ticks_of(low, high, decimal);
  for (const Step& step : kSteps) {
    if (multiples_count(low, high, step.size) <= most) return ticks_of(low, high, step);
  }
  return ticks_of(low, high, decimal);
}

Ticks step_ticks(double low, double high, double first, double step, int most) {
  if (low > high) std::swap(low, high);
  if (!usable(low, high) || most < 1 || !(step > 0.0) || !std::isfinite(first)) return {};
  int every = 1;
  while (multiples_count(low - first, high - first, step * every) > most) ++every;
  Ticks out;
  out.step = step * every;
  for (const double v : multiples(low - first, high - first, out.step)) out.major.push_back(first + v);
  for (const double v : {first, step}) {
    while (out.decimals < 2 &&
           std::abs(v * std::pow(10, out.decimals) - std::round(v * std::pow(10, out.decimals))) > 1e-6)
      ++out.decimals;
  }
  return out;
}

std::string tick_text(double value, int decimals) {
  std::string digits = fmt::format("{:.{}f}", std::abs(value), std::max(0, decimals));
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !zero ? "\u2212" + digits : digits;
}

PixelPoint PlotFrame::at(double x_value, double y_value) const {
  return {place.x + (x_value - x.first) / (x.last - x.first) * place.width,
          place.y + (y_value - y.first) / (y.last - y.first) * place.height};
}

double PlotFrame::x_at(double pixel_x) const {
  return x.first + (pixel_x - place.x) / place.width * (x.last - x.first);
}
double PlotFrame::y_at(double pixel_y) const {
  return y.first + (pixel_y - place.y) / place.height * (y.last - y.first);
}

PlotAxis length_axis(double first_m, double last_m, std::string_view what, const Theme& theme) {
  const Unit unit = theme.units.length();
  return {first_m, last_m, with_unit(what, unit), false, false, unit.si};
}

PlotFrame as_read(PlotFrame plot) {
  for (PlotAxis* axis : {&plot.x, &plot.y}) {
    axis->first /= axis->unit;
    axis->last /= axis->unit;
    axis->unit = 1.0;
  }
  return plot;
}

void make_isotropic(PlotFrame& plot) {
  const double x_unit = std::abs(plot.x.last - plot.x.first) / plot.place.width;
  const double y_unit = std::abs(plot.y.last - plot.y.first) / plot.place.height;
  PlotAxis& axis = x_unit < y_unit ? plot.x : plot.y;
  const double factor = x_unit < y_unit ? y_unit / x_unit : x_unit / y_unit;
  const double middle = 0.5 * (axis.first + axis.last);
  const double half = 0.5 * (axis.last - axis.first) * factor;
  axis.first = middle - half;
  axis.last = middle + half;
}

Ticks x_ticks(const PlotFrame& axes, const Theme& theme) {
  const int most = std::max(2, static_cast<int>(axes.place.width / (5.0 * theme.text_px)));
  return axis_ticks(as_read(axes).x, most);
}

void add_axes(FrameDescription& frame, const PlotFrame& axes, const Theme& theme, const AxesStyle& style) {
  const PlotFrame plot = as_read(axes);
  const int most_y = std::max(2, static_cast<int>(plot.place.height / (3.5 * theme.text_px)));
  const Ticks x = x_ticks(plot, theme);
  const Ticks y = axis_ticks(plot.y, most_y);
  if (style.grid) add_grid(frame, plot, theme, x, y);
  PathItem marks;
  marks.stroke = {theme.axis, theme.line_px, {}};
  const TickLengths lengths = tick_lengths(theme);
  add_tick_marks(marks, plot, x.major, true, lengths.major);
  add_tick_marks(marks, plot, y.major, false, lengths.major);
  if (style.minor) {
    add_tick_marks(marks, plot, x.minor, true, lengths.minor);
    add_tick_marks(marks, plot, y.minor, false, lengths.minor);
  }
  frame.items.emplace_back(std::move(marks));
  frame.items.emplace_back(rectangle_item(plot.place, {0, 0, 0, 0}, theme.axis, theme.line_px));
  add_x_texts(frame, plot, theme, x);
  add_y_texts(frame, plot, theme, y);
}

}  // namespace sonar
