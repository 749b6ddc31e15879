// SPDX-License-Identifier: Apache-2.0
#include "view/charts/leg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "view/charts/chart_axes.h"
#include "view/charts/measured_marks.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 24.0;
constexpr double kLeastHeight_em = 18.0;
constexpr double kLeastSpeed_mps = 0.1;
constexpr double kBeside = 0.12;  ///< of a leg: the two marks stand side by side
constexpr double kHead = 0.2;     ///< of the axis, above the marks, for what a leg is

/// Both ways, so that 0 is in sight.
double most_of(const LegChartData& data) {
  double most = kLeastSpeed_mps;
  for (const LegSpeed& leg : data.legs) {
    most = std::max({most, std::abs(leg.along_mps) + leg.along_se_mps, std::abs(leg.cross_mps) + leg.cross_se_mps});
  }
  return most;
}

std::vector<ChartTick> leg_ticks(std::size_t legs, double width_px, const Theme& theme) {
  const auto each =
      static_cast<std::size_t>(std::ceil(static_cast<double>(legs) * 3.0 * theme.text_px / std::max(1.0, width_px)));
  std::vector<ChartTick> out;
  for (std::size_t i = 0; i < legs; i += std::max<std::size_t>(1, each)) {
    out.push_back({static_cast<double>(i + 1), fmt::format("{}", i + 1)});
  }
  return out;
}

std::vector<ChartTick> speed_ticks(double most_mps, double height_px, const Theme& theme) {
  const Unit unit = theme.units.speed();
  const double most = unit.of(most_mps);
  const Ticks ticks = nice_ticks(-most, most, std::max(3, static_cast<int>(height_px / (2.6 * theme.text_px))));
  std::vector<ChartTick> out;
  for (const double at : ticks.major) out.push_back({at * unit.si, tick_text(at, ticks.decimals)});
  return out;
}

/// The course above each leg, where that has room.
void add_courses(FrameDescription& frame, const PlotFrame& plot, const LegChartData& data, const Theme& theme) {
  const double each_px = plot.place.width / static_cast<double>(data.legs.size());
  const double size_px = small_text_px(theme, 0.9);
  for (std::size_t i = 0; i < data.legs.size(); ++i) {
    const LegSpeed& leg = data.legs[i];
    const double x = plot.at(static_cast<double>(i + 1), 0.0).x;
    const std::string lines[] = {fmt::format("course {:03.0f}\u00B0", leg.course_deg), count_of(leg.schools, "school")};
    double y = plot.place.y + 0.9 * theme.text_px;
    for (const std::string& line : lines) {
      if (text_width_px(line.c_str(), size_px) > each_px) return;
      frame.items.emplace_back(text_item({x, y}, line, size_px, theme.muted, TextAnchor::centre));
      y += 1.2 * theme.text_px;
    }
  }
}

void add_words(FrameDescription& frame, const PixelRect& place, const LegChartData& data, const Theme& theme) {
  double y = place.y + 0.5 * kFootLine_em * theme.text_px;
  for (const std::string& line : data.words) {
    frame.items.emplace_back(
        text_item({place.x, y}, elided(line, theme.text_px, place.width), theme.text_px, theme.text));
    y += kFootLine_em * theme.text_px;
  }
}

}  // namespace

std::optional<std::size_t> LegChart::leg_at(const LegChartData& data, PixelPoint at) const {
  if (!inside(plot.place, at) || data.legs.empty()) return std::nullopt;
  const double i = std::clamp(std::round(plot.x_at(at.x)) - 1.0, 0.0, static_cast<double>(data.legs.size() - 1));
  return static_cast<std::size_t>(i);
}

Result<LegChart> leg_chart(const LegChartData& data, PixelSize size, const Theme& theme) {
  if (size.width < kLeastWidth_em * theme.text_px || size.height < kLeastHeight_em * theme.text_px) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
  }
  if (data.legs.empty()) return fail(ErrorCode::not_found, "there is no course leg to show");
  const MarkLook along{school_colour(1), true};
  const MarkLook cross{school_colour(2), true};
  const std::vector<KeyEntry> key{mark_entry("along the ship's course", along, theme),
                                  mark_entry("to starboard of it", cross, theme)};
  const Layout layout = lay_out(
      size, theme, {.title_lines = 2, .colour_bar = false, .foot_lines = 1 + static_cast<int>(data.words.size())});
  LegChart out;
  out.frame.size = size;
  out.frame.background = theme.background;
  out.frame.title = data.title;
  const double most = most_of(data) * 1.1;
  out.plot = {layout.plot,
              {0.5, static_cast<double>(data.legs.size()) + 0.5, "course leg"},
              {most * (1.0 + 2.0 * kHead), -most, with_unit("mean speed of the schools", theme.units.speed())}};
  out.frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  const auto y = speed_ticks(most, layout.plot.height, theme);
  add_chart_grid(out.frame, out.plot, {}, y, theme);
  add_chart_axes(out.frame, out.plot, leg_ticks(data.legs.size(), layout.plot.width, theme), y, theme);
  add_zero_line(out.frame, out.plot, theme);
  for (std::size_t i = 0; i < data.legs.size(); ++i) {
    const LegSpeed& leg = data.legs[i];
    const auto x = static_cast<double>(i + 1);
    add_measured(out.frame, out.plot, {x - kBeside, leg.along_mps, leg.along_se_mps}, along, theme);
    add_measured(out.frame, out.plot, {x + kBeside, leg.cross_mps, leg.cross_se_mps}, cross, theme);
  }
  add_courses(out.frame, out.plot, data, theme);
  add_title(out.frame, layout, theme,
            {data.title, "mean speed over ground on each course leg, with one standard error"});
  PixelRect foot = layout.foot;
  foot.height = kFootLine_em * theme.text_px;
  add_key(out.frame, foot, key, theme);
  foot.y += foot.height;
  add_words(out.frame, foot, data, theme);
  return out;
}

std::string leg_text(const LegSpeed& leg, const Units& units) {
  const Unit unit = units.speed();
  return fmt::format(
      "{} UTC\ncourse {:03.0f}\u00B0, ship {}, {}\nalong {:+.3f} \u00B1 {}\nto starboard {:+.3f} \u00B1 {}", leg.begins,
      leg.course_deg, quantity_text(leg.ship_mps, 1, unit), count_of(leg.schools, "school"), unit.of(leg.along_mps),
      quantity_text(leg.along_se_mps, 3, unit), unit.of(leg.cross_mps), quantity_text(leg.cross_se_mps, 3, unit));
}

}  // namespace sonar
