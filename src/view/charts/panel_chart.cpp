// SPDX-License-Identifier: Apache-2.0
#include "view/charts/panel_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "view/key_rows.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 14.0;
constexpr double kLeastHeight_em = 9.0;
constexpr double kLeastPlotWidth_em = 6.0;  ///< of one of several panels
constexpr double kLeastPlotHeight_em = 4.0;
constexpr double kBetween_em = 0.8;   ///< rows of panels
constexpr double kKeyFrom_em = 18.0;  ///< a lower picture has no key and no caution
constexpr double kPad = 0.06;         ///< of an axis, beyond what is on it
constexpr double kDash_px = 5.0;
constexpr int kMostKeyLines = 3;
constexpr double kCautionShare = 0.9;  ///< of the text's size
constexpr std::uint8_t kStretchAlpha = 45;

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

PathItem path_of(Rgba8 colour, double width_px, bool dashed, const Theme& theme) {
  PathItem path;
  path.stroke = {colour, width_px * theme.line_px, {}};
  if (dashed) path.stroke.dashes_px = {kDash_px * theme.line_px, 0.7 * kDash_px * theme.line_px};
  return path;
}

Rgba8 stretch_colour(const Theme& theme) { return with_alpha(theme.muted, kStretchAlpha); }

/// One panel into its plot.
class Drawing {
 public:
  Drawing(PanelChart& out, std::size_t panel, const Theme& theme)
      : out_(out), panel_(panel), plot_(out.plots[panel]), theme_(theme) {}

  void draw(const ChartPanel& panel) {
    if (panel.stretch) stretch(*panel.stretch);
    for (const ChartMark& mark : panel.marks) {
      PathItem path = path_of(mark.colour, 1.2, true, theme_);
      const double x = plot_.at(mark.at, plot_.y.first).x;
      path.parts.push_back({{{x, plot_.place.y}, {x, plot_.place.y + plot_.place.height}}, false});
      out_.frame.items.emplace_back(std::move(path));
    }
    for (std::size_t i = 0; i < panel.curves.size(); ++i) draw(panel.curves[i], i);
  }

 private:
  void draw(const ChartCurve& curve, std::size_t index) {
    line(curve);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint& point = curve.points[i];
      if (!std::isfinite(point.y)) continue;
      bar(curve, point);
      if (!curve.dots) continue;
      const PixelPoint at = plot_.at(point.x, point.y);
      disc(at, curve);
      out_.places.push_back({at, panel_, index, i});
    }
  }

  void stretch(const ChartStretch& one) {
    const double left = plot_.at(one.from, plot_.y.first).x;
    const double right = plot_.at(one.to, plot_.y.first).x;
    out_.frame.items.emplace_back(
        rectangle_item({left, plot_.place.y, std::max(1.0, right - left), plot_.place.height}, stretch_colour(theme_)));
  }

  /// A point that is not known breaks it.
  void line(const ChartCurve& curve) {
    PathItem path = path_of(curve.colour, curve.muted ? 1.0 : 1.6, curve.muted, theme_);
    PathItem::Part part;
    const auto end = [&] {
      if (part.points.size() > 1) path.parts.push_back(part);
      part.points.clear();
    };
    for (const CurvePoint& point : curve.points) {
      if (std::isfinite(point.y)) {
        part.points.push_back(plot_.at(point.x, point.y));
      } else {
        end();
      }
    }
    end();
    if (!path.parts.empty()) out_.frame.items.emplace_back(std::move(path));
  }

  void bar(const ChartCurve& curve, const CurvePoint& point) {
    if (!std::isfinite(point.low) || !std::isfinite(point.high)) return;
    const PixelPoint low = plot_.at(point.x, point.low);
    const PixelPoint high = plot_.at(point.x, point.high);
    const double half = 0.25 * theme_.text_px;
    const double width = theme_.line_px;
    out_.frame.items.emplace_back(line_item(low, high, curve.colour, width));
    for (const PixelPoint& end : {low, high}) {
      out_.frame.items.emplace_back(line_item({end.x - half, end.y}, {end.x + half, end.y}, curve.colour, width));
    }
  }

  void disc(PixelPoint at, const ChartCurve& curve) {
    constexpr int kCorners = 16;
    constexpr double kTurn = 6.283185307179586;
    const double r = (curve.muted ? 0.17 : 0.28) * theme_.text_px;
    std::vector<PixelPoint> ring;
    for (int i = 0; i < kCorners; ++i) {
      ring.push_back({at.x + r * std::cos(kTurn * i / kCorners), at.y + r * std::sin(kTurn * i / kCorners)});
    }
    out_.frame.items.emplace_back(
        polyline_item(std::move(ring), true, theme_.background, 0.5 * theme_.line_px, curve.colour));
  }

  PanelChart& out_;
  std::size_t panel_;
  const PlotFrame& plot_;
  const Theme& theme_;
};

std::vector<KeyEntry> key_of(const PanelChartData& data, std::size_t shown, const Theme& theme) {
  std::vector<KeyEntry> out;
  std::set<std::string> named{""};
  const auto line = [&](const std::string& name, Rgba8 colour, bool muted) {
    if (!named.insert(name).second) return;
    out.push_back({name, [colour, muted, &theme](FrameDescription& frame, const PixelRect& swatch) {
                     const double y = swatch.y + 0.5 * swatch.height;
                     PathItem path = path_of(colour, muted ? 1.0 : 2.0, muted, theme);
                     path.parts.push_back({{{swatch.x, y}, {swatch.x + swatch.width, y}}, false});
                     frame.items.emplace_back(std::move(path));
                   }});
  };
  for (std::size_t i = 0; i < shown; ++i) {
    const ChartPanel& panel = data.panels[i];
    for (const ChartCurve& curve : panel.curves) line(curve.name, curve.colour, curve.muted);
    for (const ChartMark& mark : panel.marks) line(mark.name, mark.colour, true);
    if (!panel.stretch || !named.insert(panel.stretch->name).second) continue;
    out.push_back({panel.stretch->name, [&theme](FrameDescription& frame, const PixelRect& swatch) {
                     frame.items.emplace_back(rectangle_item(swatch, stretch_colour(theme)));
                   }});
  }
  return out;
}

/// What the axes of a panel span; empty where no point is known.
std::optional<std::pair<Span, Span>> spans_of(const ChartPanel& panel) {
  Span x;
  Span y;
  for (const ChartCurve& curve : panel.curves) {
    for (const CurvePoint& point : curve.points) {
      if (!std::isfinite(point.y)) continue;
      x.add(point.x);
      y.add(point.y);
      y.add(point.low);
      y.add(point.high);
    }
  }
  if (!x.known()) return std::nullopt;
  for (const ChartMark& mark : panel.marks) x.add(mark.at);
  x.widen(panel.least_x);
  y.widen(panel.least_y);
  return std::pair{x, y};
}

/// Places of as many panels as have room.
std::vector<PixelRect> places_of(const PanelChartData& data, PixelSize size, const Layout& layout, const Theme& theme) {
  const double em = theme.text_px;
  const double left = layout.plot.x;
  const double right = size.width - left - layout.plot.width;
  const double bottom = layout.foot.height > 0.0 ? layout.foot.y : size.height;
  const double below = bottom - layout.plot.y - layout.plot.height;
  const auto fit = [](double room, double least) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(room / least));
  };
  const std::size_t across =
      std::min(std::max<std::size_t>(1, data.across), fit(size.width, left + right + kLeastPlotWidth_em * em));
  const std::size_t rows = std::min((data.panels.size() + across - 1) / across,
                                    fit(bottom - layout.plot.y, below + (kLeastPlotHeight_em + kBetween_em) * em));
  const double width = size.width / static_cast<double>(across);
  const double height = (bottom - layout.plot.y) / static_cast<double>(rows);
  std::vector<PixelRect> out;
  for (std::size_t i = 0; i < std::min(data.panels.size(), rows * across); ++i) {
    const auto column = static_cast<double>(i % across);
    const auto row = static_cast<double>(i / across);
    const double between = i < across ? 0.0 : kBetween_em * em;
    out.push_back({std::round(column * width + left), std::round(layout.plot.y + row * height + between),
                   std::max(8.0, std::round(width - left - right)),
                   std::max(8.0, std::round(height - below - between))});
  }
  return out;
}

void add_panel(PanelChart& out, const ChartPanel& panel, const PixelRect& place, const Theme& theme) {
  const double em = theme.text_px;
  const auto spans = spans_of(panel);
  const auto& [x, y] = spans ? *spans : std::pair<Span, Span>{{0.0, 1.0}, {0.0, 1.0}};
  PlotFrame plot{place,
                 {x.low, x.high, elided(panel.x_label, em, place.width + 4.0 * em), false},
                 {y.high, y.low, elided(panel.y_label, em, place.height + 3.0 * em), false}};
  if (panel.downwards) std::swap(plot.y.first, plot.y.last);
  out.plots.push_back(plot);
  out.frame.items.emplace_back(rectangle_item(place, theme.plot));
  add_axes(out.frame, plot, theme, {true, true});
  if (!spans) {
    const PixelPoint middle{place.x + 0.5 * place.width, place.y + 0.5 * place.height};
    out.frame.items.emplace_back(text_item(middle, "unknown", em, theme.muted, TextAnchor::centre));
    return;
  }
  out.frame.items.emplace_back(ClipItem{place});
  Drawing(out, out.plots.size() - 1, theme).draw(panel);
  out.frame.items.emplace_back(ClipItem{});
}

void add_foot(FrameDescription& frame, const Layout& layout, int lines, const std::vector<KeyEntry>& key,
              const std::vector<std::string>& caution, const Theme& theme) {
  PixelRect foot = layout.foot;
  foot.height = lines * kFootLine_em * theme.text_px;
  add_key(frame, foot, key, theme);
  double below = foot.y + foot.height + 0.5 * kFootLine_em * theme.text_px;
  const double small = small_text_px(theme, kCautionShare);
  for (const std::string& line : caution) {
    frame.items.emplace_back(
        text_item({layout.foot.x, below}, elided(line, small, layout.foot.width), small, theme.muted));
    below += kFootLine_em * theme.text_px;
  }
}

/// Broken at spaces into so many lines at most, the last of which may be cut.
std::vector<std::string> broken(const std::string& text, double width_px, double size_px, std::size_t most) {
  std::vector<std::string> lines = wrapped(text, width_px, size_px);
  while (lines.size() > most) {
    const std::string last = std::move(lines.back());
    lines.pop_back();
    lines.back() += " " + last;
  }
  return lines;
}

/// What is told, in lines of a width, where the picture is high enough for more than one of each text.
struct Told {
  std::vector<std::string> title;
  std::vector<std::string> caution;
};

Told told_in(const PanelChartData& data, PixelSize size, const Theme& theme) {
  constexpr double kMore_em = 4.0;  // of height for one more line of each text, so that the plot stays
  const double em = theme.text_px;
  const double spare_em = size.height / em - kKeyFrom_em;
  const Layout layout = lay_out(size, theme, {.colour_bar = false, .y_label_characters = 4, .foot_lines = 1});
  const std::size_t most = spare_em < kMore_em ? 1 : spare_em < 2.0 * kMore_em ? 2 : 3;
  Told out{{data.title}, {}};
  for (std::string& line : broken(data.below, layout.title.width, em, most)) out.title.push_back(std::move(line));
  if (spare_em >= 0.0 && !data.caution.empty()) {
    out.caution = broken(data.caution, layout.foot.width, small_text_px(theme, kCautionShare), most);
  }
  return out;
}

}  // namespace

const PanelChart::Place* PanelChart::at(PixelPoint pixel, double reach_px) const {
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

Result<PanelChart> panel_chart(const PanelChartData& data, PixelSize size, const Theme& theme) {
  const double em = theme.text_px;
  if (size.width < kLeastWidth_em * em || size.height < kLeastHeight_em * em) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
  }
  const bool any = std::any_of(data.panels.begin(), data.panels.end(),
                               [](const ChartPanel& panel) { return spans_of(panel).has_value(); });
  if (!any) return fail(ErrorCode::not_found, "nothing is known that the chart could show");
  const bool with_key = size.height >= kKeyFrom_em * em;
  const std::vector<KeyEntry> key = with_key ? key_of(data, data.panels.size(), theme) : std::vector<KeyEntry>{};
  LayoutNeeds needs{.colour_bar = false, .y_label_characters = 4, .foot_lines = 1};
  const int lines = std::min(kMostKeyLines, key_lines(key, lay_out(size, theme, needs).foot.width, theme));
  Told told = told_in(data, size, theme);
  needs.title_lines = static_cast<int>(told.title.size());
  needs.foot_lines = with_key ? lines + static_cast<int>(told.caution.size()) : 0;
  const Layout layout = lay_out(size, theme, needs);
  PanelChart out;
  out.frame.size = size;
  out.frame.background = theme.background;
  out.frame.title = data.title;
  const std::vector<PixelRect> places = places_of(data, size, layout, theme);
  out.plots.reserve(places.size());  // drawing points to them
  for (std::size_t i = 0; i < places.size(); ++i) add_panel(out, data.panels[i], places[i], theme);
  if (places.size() < data.panels.size()) {
    told.title.back() += "; no room for " + count_of(data.panels.size() - places.size(), "more panel");
  }
  add_title(out.frame, layout, theme, told.title);
  if (needs.foot_lines > 0) add_foot(out.frame, layout, lines, key, told.caution, theme);
  return out;
}

}  // namespace sonar
