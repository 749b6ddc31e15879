// SPDX-License-Identifier: Apache-2.0
#include "view/charts/cause_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "view/axes.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 18.0;
constexpr double kLeastHeight_em = 11.0;
constexpr double kPad_db = 0.5;
constexpr double kNames_em = 9.0;   ///< room for the names at the left
constexpr double kBarHeight = 0.4;  ///< of a row
constexpr Rgba8 kBar{0, 114, 178, 255};

void add_bar(FrameDescription& frame, const PlotFrame& plot, const CauseBar& bar, double row, const Theme& theme) {
  const double em = theme.text_px;
  const double y = plot.at(0.0, row).y;
  frame.items.emplace_back(
      text_item({plot.place.x - 0.6 * em, y}, elided(bar.name, em, kNames_em * em), em, theme.text, TextAnchor::right));
  if (!std::isfinite(bar.down_db) || !std::isfinite(bar.up_db)) {
    frame.items.emplace_back(text_item({plot.at(0.0, row).x, y}, "not known", em, theme.muted, TextAnchor::centre));
    return;
  }
  const double half = kBarHeight * std::abs(plot.at(0.0, 1.0).y - plot.at(0.0, 0.0).y) / 2.0;
  const PixelPoint low = plot.at(bar.down_db, row);
  const PixelPoint high = plot.at(bar.up_db, row);
  frame.items.emplace_back(
      rectangle_item({low.x, y - half, std::max(high.x - low.x, theme.line_px), 2.0 * half}, kBar));
  for (const CauseBar::Mark& mark : bar.marks) {
    const PixelPoint at = plot.at(mark.at_db, row);
    frame.items.emplace_back(
        line_item({at.x, y - 1.4 * half}, {at.x, y + 1.4 * half}, theme.text, 1.5 * theme.line_px));
  }
  const std::string span = fmt::format("{:+.1f} to {:+.1f} dB", bar.down_db, bar.up_db);
  TextItem said = text_item({plot.place.x + plot.place.width - 0.4 * em, y - 1.5 * half}, span,
                            small_text_px(theme, 0.9), theme.muted, TextAnchor::right);
  said.halo = theme.halo;
  frame.items.emplace_back(std::move(said));
}

}  // namespace

Result<FrameDescription> cause_chart(const std::string& title, const std::vector<CauseBar>& bars, PixelSize size,
                                     const Theme& theme) {
  const double em = theme.text_px;
  if (size.width < kLeastWidth_em * em || size.height < kLeastHeight_em * em) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
  }
  double low = 0.0;
  double high = 0.0;
  bool known = false;
  for (const CauseBar& bar : bars) {
    if (!std::isfinite(bar.down_db) || !std::isfinite(bar.up_db)) continue;
    known = true;
    low = std::min(low, bar.down_db);
    high = std::max(high, bar.up_db);
  }
  if (!known) return fail(ErrorCode::not_found, "no school has a number of fish");
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = title;
  Layout layout = lay_out(size, theme, {.colour_bar = false, .y_axis = false});
  const double names = kNames_em * em + em;
  layout.plot.x += names;
  layout.plot.width -= names;
  const PlotFrame plot{layout.plot,
                       {low - kPad_db, high + kPad_db, "change of the number of fish (dB)"},
                       {-0.5, static_cast<double>(bars.size()) - 0.5, ""}};
  frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  const Ticks ticks =
      nice_ticks(plot.x.first, plot.x.last, std::max(2, static_cast<int>(layout.plot.width / (4.0 * em))));
  const double bottom = layout.plot.y + layout.plot.height;
  for (const double tick : ticks.major) {
    const double x = plot.at(tick, 0.0).x;
    frame.items.emplace_back(
        line_item({x, layout.plot.y}, {x, bottom}, tick == 0.0 ? theme.axis : theme.grid, theme.line_px));
    frame.items.emplace_back(
        text_item({x, bottom + 1.1 * em}, tick_text(tick, ticks.decimals), em, theme.text, TextAnchor::centre));
  }
  frame.items.emplace_back(text_item({layout.plot.x + layout.plot.width / 2.0, bottom + 2.5 * em},
                                     elided(plot.x.label, em, layout.plot.width), em, theme.muted, TextAnchor::centre));
  for (std::size_t i = 0; i < bars.size(); ++i) add_bar(frame, plot, bars[i], static_cast<double>(i), theme);
  add_title(frame, layout, theme, {title, "each cause alone; errors at 95 %, choices at their extremes"});
  return frame;
}

}  // namespace sonar
