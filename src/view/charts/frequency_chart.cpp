// SPDX-License-Identifier: Apache-2.0
#include "view/charts/frequency_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "view/colour_bar.h"
#include "view/key_rows.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 14.0;
constexpr double kLeastHeight_em = 9.0;
constexpr double kKeyFrom_em = 18.0;  ///< a lower picture has no key and no caution
constexpr double kPad = 0.06;         ///< of an axis, beyond what is on it
constexpr double kLeastSpan_db = 4.0;
constexpr double kLeastSpan_khz = 2.0;
constexpr double kDash_px = 5.0;
constexpr int kMostKeyLines = 3;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool known() const { return low <= high; }
  void widen(double least) {
    const double missing = std::max(0.0, least - (high - low)) / 2.0;
    const double pad = kPad * std::max(least, high - low);
    low -= missing + pad;
    high += missing + pad;
  }
};

class Drawing {
 public:
  Drawing(FrequencyChart& out, const Theme& theme) : out_(out), theme_(theme) {}

  void add(const FrequencySeries& series, std::size_t index) {
    line(series);
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const FrequencyPoint& point = series.points[i];
      if (!std::isfinite(point.sv_db)) continue;
      const PixelPoint at = out_.plot.at(point.frequency_khz, point.sv_db);
      if (!series.muted) spread(series, point);
      disc(at, series);
      out_.places.push_back({at, index, i});
    }
  }

 private:
  [[nodiscard]] double radius() const { return 0.28 * theme_.text_px; }

  /// From fan to fan; a fan that is not known breaks it.
  void line(const FrequencySeries& series) {
    PathItem path;
    path.stroke = {series.colour, (series.muted ? 1.0 : 1.6) * theme_.line_px, {}};
    if (series.muted) path.stroke.dashes_px = {kDash_px * theme_.line_px, 0.7 * kDash_px * theme_.line_px};
    PathItem::Part part;
    const auto end = [&] {
      if (part.points.size() > 1) path.parts.push_back(part);
      part.points.clear();
    };
    for (const FrequencyPoint& point : series.points) {
      if (std::isfinite(point.sv_db)) {
        part.points.push_back(out_.plot.at(point.frequency_khz, point.sv_db));
      } else {
        end();
      }
    }
    end();
    if (!path.parts.empty()) out_.frame.items.emplace_back(std::move(path));
  }

  void spread(const FrequencySeries& series, const FrequencyPoint& point) {
    if (!std::isfinite(point.low_db) || !std::isfinite(point.high_db)) return;
    const PixelPoint low = out_.plot.at(point.frequency_khz, point.low_db);
    const PixelPoint high = out_.plot.at(point.frequency_khz, point.high_db);
    const double half = 0.25 * theme_.text_px;
    const double width = theme_.line_px;
    out_.frame.items.emplace_back(line_item(low, high, series.colour, width));
    for (const PixelPoint& end : {low, high}) {
      out_.frame.items.emplace_back(line_item({end.x - half, end.y}, {end.x + half, end.y}, series.colour, width));
    }
  }

  void disc(PixelPoint at, const FrequencySeries& series) {
    constexpr int kCorners = 16;
    constexpr double kTurn = 6.283185307179586;
    const double r = series.muted ? 0.6 * radius() : radius();
    std::vector<PixelPoint> ring;
    for (int i = 0; i < kCorners; ++i) {
      ring.push_back({at.x + r * std::cos(kTurn * i / kCorners), at.y + r * std::sin(kTurn * i / kCorners)});
    }
    out_.frame.items.emplace_back(
        polyline_item(std::move(ring), true, theme_.background, 0.5 * theme_.line_px, series.colour));
  }

  FrequencyChart& out_;
  const Theme& theme_;
};

KeyEntry entry_of(const FrequencySeries& series, const Theme& theme) {
  return {series.name, [&series, &theme](FrameDescription& frame, const PixelRect& swatch) {
            const double y = swatch.y + 0.5 * swatch.height;
            PathItem path;
            path.parts.push_back({{{swatch.x, y}, {swatch.x + swatch.width, y}}, false});
            path.stroke = {series.colour, (series.muted ? 1.0 : 2.0) * theme.line_px, {}};
            if (series.muted) path.stroke.dashes_px = {kDash_px * theme.line_px, 0.7 * kDash_px * theme.line_px};
            frame.items.emplace_back(std::move(path));
          }};
}

Result<std::pair<Span, Span>> spans_of(const FrequencyChartData& data) {
  Span x;
  Span y;
  for (const FrequencySeries& series : data.series) {
    for (const FrequencyPoint& point : series.points) {
      if (!std::isfinite(point.sv_db)) continue;
      x.add(point.frequency_khz);
      y.add(point.sv_db);
      if (series.muted) continue;
      y.add(point.low_db);
      y.add(point.high_db);
    }
  }
  if (!x.known() || !y.known()) {
    return fail(ErrorCode::not_found, "no fan hears a school above the background: there is no frequency to compare");
  }
  x.widen(kLeastSpan_khz);
  y.widen(kLeastSpan_db);
  return std::pair{x, y};
}

}  // namespace

const char* frequency_caution() {
  return "Fans differ in tilt as well as in frequency: they see fish from other sides, and other parts of the school.";
}

const FrequencyChart::Place* FrequencyChart::at(PixelPoint pixel, double reach_px) const {
  const Place* nearest = nullptr;
  double best = reach_px;
  for (const Place& place : places) {
    const double away = std::hypot(place.at.x - pixel.x, place.at.y - pixel.y);
    if (away > best) continue;
    best = away;
    nearest = &place;
  }
  return nearest;
}

Result<FrequencyChart> frequency_chart(const FrequencyChartData& data, PixelSize size, const Theme& theme) {
  const double em = theme.text_px;
  if (size.width < kLeastWidth_em * em || size.height < kLeastHeight_em * em) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
  }
  const auto spans = spans_of(data);
  if (!spans) return pass_on(spans);
  const bool with_key = size.height >= kKeyFrom_em * em;
  std::vector<KeyEntry> key;
  if (with_key) {
    for (const FrequencySeries& series : data.series) key.push_back(entry_of(series, theme));
  }
  LayoutNeeds needs{.colour_bar = false, .y_label_characters = 4, .foot_lines = 1};
  const int lines = std::min(kMostKeyLines, key_lines(key, lay_out(size, theme, needs).foot.width, theme));
  needs.foot_lines = with_key ? lines + 1 : 0;
  const Layout layout = lay_out(size, theme, needs);
  FrequencyChart out;
  out.frame.size = size;
  out.frame.background = theme.background;
  out.frame.title = data.title;
  const auto& [x, y] = *spans;
  out.plot = {layout.plot, {x.low, x.high, "frequency (kHz)", false}, {y.high, y.low, kSvLabel, false}};
  out.frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  add_axes(out.frame, out.plot, theme, {true, true});
  out.frame.items.emplace_back(ClipItem{layout.plot});
  Drawing drawing(out, theme);
  for (std::size_t i = 0; i < data.series.size(); ++i) drawing.add(data.series[i], i);
  out.frame.items.emplace_back(ClipItem{});
  add_title(out.frame, layout, theme, {data.title, "mean Sv of each fan over its frequency, " + data.pings});
  if (!with_key) return out;
  PixelRect foot = layout.foot;
  foot.height = lines * kFootLine_em * em;
  add_key(out.frame, foot, key, theme);
  const double below = foot.y + foot.height + 0.5 * kFootLine_em * em;
  out.frame.items.emplace_back(text_item({layout.foot.x, below},
                                         elided(frequency_caution(), small_text_px(theme, 0.9), layout.foot.width),
                                         small_text_px(theme, 0.9), theme.muted));
  return out;
}

std::string frequency_point_text(const FrequencySeries& series, const FrequencyPoint& point) {
  std::string text = fmt::format("{}\nfan {}, {:.1f} kHz: {:.1f} dB re 1 m\u207B\u00B9", series.name, point.fan,
                                 point.frequency_khz, point.sv_db);
  if (std::isfinite(point.low_db) && std::isfinite(point.high_db)) {
    text += fmt::format("\nhalf of the pings: {:.1f} to {:.1f} dB", point.low_db, point.high_db);
  }
  return text + fmt::format("\n{}, {}, {:.3g} m\u00B3", count_of(static_cast<std::size_t>(point.pings), "ping"),
                            count_of(static_cast<std::size_t>(point.samples), "sample"), point.volume_m3);
}

}  // namespace sonar
