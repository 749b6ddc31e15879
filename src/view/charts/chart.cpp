// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "view/charts/chart_axes.h"
#include "view/charts/chart_bins.h"
#include "view/charts/chart_marks.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 14.0;
constexpr double kLeastHeight_em = 9.0;
constexpr double kTitleFrom_em = 22.0;  ///< a lower picture in a window has one line above the plot
constexpr double kKeyFrom_em = 18.0;    ///< and no key
constexpr int kMostKeyLines = 3;

std::string counts_text(const ChartData& data) {
  const std::size_t known = data.known_rows();
  std::string text = count_of(known, data.row_word());
  if (known < data.rows.size()) text += fmt::format(" \u00B7 {} left out: unknown", data.rows.size() - known);
  return text;
}

std::string what_text(const ChartData& data) {
  const std::string of = fmt::format(" of {}", data.table == ChartTable::schools ? "schools" : "schools, ping by ping");
  if (data.y) return fmt::format("{} over {}{}", column_words(*data.y), column_words(data.x), of);
  return column_words(data.x) + of;
}

Result<void> require_something(const ChartData& data, PixelSize size, const Theme& theme) {
  const double em = theme.text_px;
  if (size.width < kLeastWidth_em * em || size.height < kLeastHeight_em * em) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
  }
  if (data.rows.empty()) return fail(ErrorCode::not_found, "there are no schools to chart");
  if (data.known_rows() > 0) return {};
  const std::string what = data.y ? fmt::format("{} or {}", data.x.name, data.y->name) : std::string(data.x.name);
  return fail(ErrorCode::not_found, fmt::format("{} is unknown in every row of {}: there is nothing to chart", what,
                                                kChartTableNames[static_cast<std::size_t>(data.table)]));
}

/// Both axes, and the bins of a histogram.
struct Scales {
  ChartAxis x;
  ChartAxis y;
  ChartBins bins;
  ChartPart whole;
};

/// Values of rows that are drawn; the others are NaN.
std::vector<double> known_values(const ChartData& data, std::vector<double> values) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!data.known(row)) values[row] = std::nan("");
  }
  return values;
}

Scales scales_of(const ChartData& data, const ChartStyle& style) {
  Scales scales;
  if (data.y) {
    scales.x = chart_axis(data.x, known_values(data, data.x_values));
    scales.y = chart_axis(*data.y, known_values(data, data.y_values));
  } else {
    scales.bins = chart_bins(data.x_values, data.x, style.bins);
    std::vector<double> counts(scales.bins.count());
    for (const std::size_t bin : scales.bins.bin_of_row) {
      if (bin != ChartBins::kNone) counts[bin] += 1.0;
    }
    scales.x = chart_axis(data.x, scales.bins.edges);
    const std::string_view what = data.table == ChartTable::schools ? "n_schools" : "n_school_pings";
    scales.y = chart_axis({.name = what, .unit = "1", .whole = true}, counts, true);
  }
  scales.whole = {scales.x.low, scales.x.high, scales.y.low, scales.y.high};
  if (!style.shown) return scales;
  scales.x = part_of(scales.x, style.shown->x_low, style.shown->x_high);
  if (data.y) scales.y = part_of(scales.y, style.shown->y_low, style.shown->y_high);
  return scales;
}

std::vector<std::string> title_lines(const ChartData& data, const ChartStyle& style, PixelSize size,
                                     const Theme& theme) {
  const std::string counts = counts_text(data);
  if (!style.brief) return {data.title, what_text(data) + " \u00B7 " + counts};
  if (size.height >= kTitleFrom_em * theme.text_px) return {data.title, counts};
  const bool synthetic = data.title.find("SYNTHETIC") != std::string::npos;
  return {synthetic ? "SYNTHETIC \u00B7 " + counts : counts};
}

std::vector<KeyEntry> key_of(const ChartLooks& looks, const ChartStyle& style, PixelSize size, const Theme& theme) {
  if (style.brief && size.height < kKeyFrom_em * theme.text_px) return {};
  std::vector<KeyEntry> key = looks.key();
  const double width = lay_out(size, theme, {.colour_bar = false, .foot_lines = 1}).foot.width;
  return key_lines(key, width, theme) > (style.brief ? 1 : kMostKeyLines) ? looks.short_key() : key;
}

/// How many characters the longest number of the upright axis has.
int characters(const std::vector<ChartTick>& ticks) {
  double widest = 0.0;
  for (const ChartTick& tick : ticks) widest = std::max(widest, text_width_px(tick.text.c_str(), 1.0));
  return std::max(2, static_cast<int>(std::ceil(widest / 0.64)));
}

void lay_points(ChartPlaces& places, const ChartData& data) {
  places.points.assign(data.rows.size(), {std::nan(""), std::nan("")});
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    if (!data.known(row)) continue;
    const PixelPoint at = places.plot.at(data.x_values[row], data.y_values[row]);
    if (inside(places.plot.place, at)) places.points[row] = at;
  }
}

}  // namespace

Result<Chart> chart(const ChartData& data, const ChartStyle& style, PixelSize size, const Theme& theme) {
  if (auto something = require_something(data, size, theme); !something) return pass_on(something);
  const Scales scales = scales_of(data, style);
  const ChartLooks looks(data, style, theme);
  const std::vector<std::string> title = title_lines(data, style, size, theme);
  const std::vector<KeyEntry> key = key_of(looks, style, size, theme);
  LayoutNeeds needs{.title_lines = static_cast<int>(title.size()), .colour_bar = false};
  if (!key.empty()) {
    needs.foot_lines = 1;
    needs.foot_lines = key_lines(key, lay_out(size, theme, needs).foot.width, theme);
  }
  needs.y_label_characters = characters(ticks_down(scales.y, lay_out(size, theme, needs).plot.height, theme));
  const Layout layout = lay_out(size, theme, needs);

  Chart out;
  out.whole = scales.whole;
  ChartPlaces& places = out.places;
  places.reach_px = style.reach_px;
  places.plot.place = layout.plot;
  places.plot.x = {scales.x.low, scales.x.high, scales.x.label, false};
  places.plot.y = {scales.y.high, scales.y.low, scales.y.label, false};
  if (data.y && data.y->downwards()) std::swap(places.plot.y.first, places.plot.y.last);
  const std::vector<ChartTick> x = ticks_across(scales.x, layout.plot.width, theme);
  const std::vector<ChartTick> y = ticks_down(scales.y, layout.plot.height, theme);

  FrameDescription& frame = out.frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = data.title;
  frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  add_chart_grid(frame, places.plot, x, y, theme);
  frame.items.emplace_back(ClipItem{layout.plot});
  if (data.y) {
    lay_points(places, data);
    add_points(frame, places, data, looks, theme);
  } else {
    add_bars(frame, places, data, scales.bins, looks, theme);
  }
  frame.items.emplace_back(ClipItem{});
  add_chart_axes(frame, places.plot, x, y, theme);
  add_key(frame, layout.foot, key, theme);
  add_title(frame, layout, theme, title);
  return out;
}

}  // namespace sonar
