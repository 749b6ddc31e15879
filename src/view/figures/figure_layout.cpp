// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/number_text.h"
#include "view/colour_bar.h"
#include "view/figures/figure_page.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kPointsPerInch = 72.0;
constexpr double kPixelsPerInch = 96.0;  ///< of a pixel of the web, in which lines are 1 wide
constexpr double kMostPixels = 64e6;     ///< as of other pictures
constexpr int kMostSide = 16384;

// In em of the text.
constexpr double kGap = 0.9;
constexpr double kHeading = 1.6;
constexpr double kLine = 1.45;
constexpr double kTitle = 1.9;
constexpr double kLegendWide = 8.6;  ///< an upright bar with its labels
constexpr double kLegendHigh = 1.4 + 0.9 + kBelowLevelBar_em + 0.6;
constexpr double kLeastWide = 14.0;  ///< of a panel
constexpr double kLeastHigh = 8.0;
constexpr double kNarrow_mm = 120.0;  ///< a page without room beside its panels

double pixels(double mm, int dpi) { return mm * dpi / kMmPerInch; }

struct Row {
  std::size_t first = 0;
  std::size_t count = 0;
  bool wide = false;
};

std::vector<Row> rows_of(std::span<const FigurePanelName> panels, int columns) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool full = rows.empty() || rows.back().wide || rows.back().count >= static_cast<std::size_t>(columns);
    if (panels[i].wide || full) {
      rows.push_back({i, 1, panels[i].wide});
    } else {
      ++rows.back().count;
    }
  }
  return rows;
}

Result<void> check_size(const FigureParams& params, std::span<const FigurePanelName> panels) {
  if (auto valid = validate(params); !valid) return valid;
  if (panels.empty()) {
    return fail(ErrorCode::bad_parameter, "no picture is chosen for the figure: expected one panel at least");
  }
  const PixelSize size = page_pixels(params);
  const double count = 1.0 * size.width * size.height;
  if (size.width <= kMostSide && size.height <= kMostSide && count <= kMostPixels) return {};
  return fail(ErrorCode::bad_parameter,
              fmt::format("{:g} x {:g} mm at {} dpi makes {} x {} pixels; expected {} a side and {:.0f} million in all "
                          "at most: take fewer dpi",
                          params.width_mm, params.height_mm, params.dpi, size.width, size.height, kMostSide,
                          kMostPixels / 1e6));
}

double lines_height(const std::string& text, double width, double em) {
  return text.empty() ? 0.0 : (kLine * static_cast<double>(wrapped(text, width, em).size()) + 0.3) * em;
}

/// Headings and panels in the rectangle that is left for them.
Result<void> place_rows(FigureLayout& out, const FigureParams& params, std::span<const FigurePanelName> panels,
                        const PixelRect& area, double em) {
  const std::vector<Row> rows = rows_of(panels, params.columns);
  std::size_t columns = 1;
  double weights = 0.0;
  const auto weight = [&](const Row& row) {
    return row.wide && rows.size() > 1 ? params.wide_height_percent / 100.0 : 1.0;
  };
  for (const Row& row : rows) {
    columns = std::max(columns, row.count);
    weights += weight(row);
  }
  const bool headed = params.letters || params.headings == FigureHeadings::names;
  const double heading = headed ? kHeading * em : 0.0;
  const double gap = kGap * em;
  const double between = static_cast<double>(rows.size() - 1) * gap + static_cast<double>(rows.size()) * heading;
  const double high = (area.height - between) / weights;
  const double wide = (area.width - static_cast<double>(columns - 1) * gap) / static_cast<double>(columns);
  double least_high = high;
  for (const Row& row : rows) least_high = std::min(least_high, high * weight(row));
  if (wide < kLeastWide * em || least_high < kLeastHigh * em) {
    const double mm = kMmPerInch / params.dpi;
    return fail(
        ErrorCode::bad_parameter,
        fmt::format("panels of {:.0f} x {:.0f} mm have no room for text of {:g} pt; expected {:.0f} x {:.0f} mm "
                    "or more: take a larger page, fewer columns or smaller text",
                    std::max(0.0, wide * mm), std::max(0.0, least_high * mm), params.text_pt,
                    std::ceil(kLeastWide * em * mm), std::ceil(kLeastHigh * em * mm)));
  }
  double y = area.y;
  for (const Row& row : rows) {
    const double height = high * weight(row);
    for (std::size_t i = 0; i < row.count; ++i) {
      const double x = area.x + static_cast<double>(i) * (wide + gap);
      const double width = row.wide ? area.width : wide;
      out.headings.push_back({x, y, width, heading});
      out.panels.push_back({x, y + heading, width, height});
    }
    y += heading + height + gap;
  }
  return {};
}

}  // namespace

FigureSize size_of(FigurePaper paper, const FigureSize& own) {
  switch (paper) {
    case FigurePaper::single_column:
      return {85.0, 80.0, 2.0};
    case FigurePaper::double_column:
      return {180.0, 120.0, 2.0};
    case FigurePaper::a4_upright:
      return {210.0, 297.0, 15.0};
    case FigurePaper::a4_across:
      return {297.0, 210.0, 15.0};
    case FigurePaper::own:
      break;
  }
  return own;
}

std::vector<FigurePanelName> panel_names(const std::string& panels) {
  std::vector<FigurePanelName> names;
  std::string_view rest = panels;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    std::string_view one = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    const bool wide = one.ends_with('+');
    if (wide) one.remove_suffix(1);
    if (!one.empty()) names.push_back({std::string(one), wide});
  }
  return names;
}

std::string panels_text(std::span<const FigurePanelName> names) {
  std::string text;
  for (const FigurePanelName& one : names) {
    if (!text.empty()) text += ',';
    text += one.name;
    if (one.wide) text += '+';
  }
  return text;
}

PixelSize page_pixels(const FigureParams& params) {
  return {static_cast<int>(std::lround(pixels(params.width_mm, params.dpi))),
          static_cast<int>(std::lround(pixels(params.height_mm, params.dpi)))};
}

PixelSize PanelDrawing::size_in(const PixelRect& place) const {
  return {static_cast<int>(place.width / on_page), static_cast<int>(place.height / on_page)};
}

PanelDrawing panel_drawing(const FigureParams& params) {
  constexpr double kCoarsest = 144.0;  ///< pictures have a least number of pixels
  constexpr double kFinest = 600.0;    ///< nobody sees finer samples; text and lines are as fine as the page
  PanelDrawing out;
  out.dots_per_inch = std::clamp(static_cast<double>(params.dpi), kCoarsest, kFinest);
  out.on_page = params.dpi / out.dots_per_inch;
  out.look.text_px = params.text_pt * out.dots_per_inch / kPointsPerInch;
  out.look.line_px = 0.75 * out.dots_per_inch / kPixelsPerInch;
  out.look.titles = params.headings == FigureHeadings::titles;
  return out;
}

Result<FigureLayout> figure_layout(const FigureParams& params, std::span<const FigurePanelName> panels, bool legend,
                                   const std::string& source) {
  if (auto possible = check_size(params, panels); !possible) return pass_on(possible);
  FigureLayout out;
  out.page = page_pixels(params);
  const double em = params.text_pt * params.dpi / kPointsPerInch;
  const double margin = pixels(params.margin_mm, params.dpi);
  PixelRect rest{margin, margin, out.page.width - 2.0 * margin, out.page.height - 2.0 * margin};
  const auto from_top = [&](double height) {
    const PixelRect taken{rest.x, rest.y, rest.width, height};
    rest.y += height;
    rest.height -= height;
    return taken;
  };
  const auto from_bottom = [&](double height) {
    rest.height -= height;
    return PixelRect{rest.x, rest.y + rest.height, rest.width, height};
  };
  if (!params.title.empty()) out.title = from_top(kTitle * em);
  if (!params.caption.empty()) out.caption = from_bottom(lines_height(params.caption, rest.width, em));
  if (!source.empty()) out.source = from_bottom(lines_height(source, rest.width, em));
  if (legend) {
    out.legend_below = params.legend == FigureLegend::below ||
                       (params.legend == FigureLegend::automatic && params.width_mm < kNarrow_mm);
    if (out.legend_below) {
      out.legend = from_bottom(kLegendHigh * em);
    } else {
      rest.width -= kLegendWide * em;
      out.legend = {rest.x + rest.width, rest.y, kLegendWide * em, rest.height};
    }
  }
  if (auto placed = place_rows(out, params, panels, rest, em); !placed) return pass_on(placed);
  return out;
}

}  // namespace sonar
