// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "view/label_room.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr std::size_t kMostSchools = 12;
constexpr double kMostOfHeight = 0.5;  ///< what the legend may take of the volume's height

double line_of(const Theme& theme) { return 1.5 * theme.text_px; }

TextItem words_item(const LegendRow& row, PixelPoint at, const Theme& theme) {
  return {at, row.words, theme.text_px, theme.text, TextAnchor::left, 0.0, false, theme.halo};
}

void add_surroundings(std::vector<LegendRow>& rows, const VolumeFigure& figure, const PictureOptions& options,
                      const Theme& theme) {
  using enum LegendRow::Sign;
  if (!figure.refused.empty()) rows.push_back({mark, {}, kRefusedWords});
  if (figure.seabed) {
    rows.push_back({area, seabed_colours().at(0.5), "seabed, of the depth chart"});
  } else if (options.volume.context && options.volume.seabed && figure.fitted) {
    rows.push_back({area, theme.land, "seabed, fitted to the ping's echoes"});
  }
  if (!options.volume.context) return;
  if (figure.shadow_from) rows.push_back({whole_line, shadow_colour(theme), "in the shadow of schools"});
  const double heading_deg = figure.navigation.heading_deg;
  const auto turned = std::isnan(heading_deg) ? std::nullopt : std::optional(heading_deg);
  const std::string current = current_words(figure.sector(), figure.currents, turned, options.units);
  if (!current.empty()) rows.push_back({whole_line, current_colour(), current});
}

void add_trails(std::vector<LegendRow>& rows, const VolumeFigure& figure, const PictureOptions& options,
                const Theme& theme) {
  using enum LegendRow::Sign;
  if (!figure.trails) return;
  const TrailParams shown = trail_params(options.volume);
  if (shown.ship_track) rows.push_back({whole_line, theme.track, "track of the ship"});
  if (!figure.schools_tracked) return;
  if (shown.school_tracks) rows.push_back({whole_line, theme.text, "tracks of schools"});
  if (shown.pings > 0) {
    const std::string words =
        shown.pings == 1 ? "schools of the ping before" : fmt::format("schools of the {} pings before", shown.pings);
    rows.push_back({whole_line, with_alpha(theme.text, 120), words});
  }
}

std::vector<LegendRow> of_schools(const VolumeFigure& figure, const PictureOptions& options, const Theme& theme) {
  using enum LegendRow::Sign;
  std::vector<LegendRow> rows;
  const std::string core = fmt::format("core, confidence {:g} and more", options.display.core_at);
  if (figure.outlined) {
    rows.push_back({broken_line, theme.text, core});
    rows.push_back({whole_line, theme.text, "fuzzy area"});
  } else {
    const float opacity = mask_style(options.display, options.volume).fuzzy_opacity;
    rows.push_back({area, theme.text, core});
    rows.push_back({area, with_alpha(theme.text, static_cast<int>(255.0F * opacity)), "fuzzy area"});
  }
  for (const auto& [colour, name] : figure.legend) rows.push_back({area, colour, name, true});
  return rows;
}

/// What the rows cover, from the origin on.
PixelRect extent_of(const std::vector<LegendRow>& rows, const Theme& theme) {
  const double line = line_of(theme);
  double width = 0.0;
  for (const LegendRow& row : rows) {
    width = std::max(width, 2.0 * line + LabelRoom::box_of(words_item(row, {}, theme)).width);
  }
  return {0.0, 0.0, width, rows.empty() ? 0.0 : line * (static_cast<double>(rows.size()) + 0.5)};
}

}  // namespace

std::vector<LegendRow> volume_legend(const VolumeFigure& figure, const PictureOptions& options, const PixelRect& place,
                                     const Theme& theme) {
  std::vector<LegendRow> rows;
  add_surroundings(rows, figure, options, theme);
  add_trails(rows, figure, options, theme);
  if (options.display.masks && !figure.legend.empty()) {
    std::vector<LegendRow> schools = of_schools(figure, options, theme);
    const double height = line_of(theme) * static_cast<double>(rows.size() + schools.size());
    if (figure.legend.size() > kMostSchools || height > kMostOfHeight * place.height) {
      schools.resize(schools.size() - figure.legend.size());
    }
    rows.insert(rows.end(), schools.begin(), schools.end());
  }
  for (LegendRow& row : rows) row.words = elided_line(row.words, theme.text_px, place.width - 3.0 * line_of(theme));
  std::erase_if(rows, [](const LegendRow& row) { return row.words.empty(); });
  return rows;
}

std::optional<PixelRect> place_off(const KeptClear& kept_clear, bool over_sector, const PixelRect& inside, double width,
                                   double height, Corner corner) {
  std::vector<ConvexOutline> shapes = kept_clear.always;
  if (!over_sector) shapes.push_back(kept_clear.sector);
  return free_place(inside, width, height, corner, shapes);
}

PlacedLegend placed_legend(const VolumeFigure& figure, const PictureOptions& options, const PixelRect& place,
                           const Theme& theme, const KeptClear& kept_clear) {
  const std::vector<LegendRow> all = volume_legend(figure, options, place, theme);
  std::vector<LegendRow> fewer = all;
  std::erase_if(fewer, [](const LegendRow& row) { return row.one_school; });
  std::vector<LegendRow> shorter = fewer;
  for (LegendRow& row : shorter) row.words.resize(std::min(row.words.size(), row.words.find(',')));
  const auto fits = [&](const std::vector<LegendRow>& rows, bool over_sector) {
    const PixelRect extent = extent_of(rows, theme);
    return place_off(kept_clear, over_sector, place, extent.width, extent.height, Corner::lower_left);
  };
  for (const auto& rows : {all, fewer, shorter}) {
    if (const auto found = fits(rows, false)) return {rows, *found, false};
  }
  if (const auto found = fits(shorter, true)) return {shorter, *found, false};
  return {{}, {place.x, place.y + place.height, 0.0, 0.0}, true};
}

void add_volume_legend(FrameDescription& frame, const PlacedLegend& legend, const Theme& theme) {
  const double em = theme.text_px;
  const double line = line_of(theme);
  const double x = legend.place.x + line;
  double y = legend.place.y + 0.5 * line;
  for (const LegendRow& row : legend.rows) {
    switch (row.sign) {
      case LegendRow::Sign::area:
        frame.items.emplace_back(
            rectangle_item({x, y - 0.4 * em, 0.8 * em, 0.8 * em}, row.colour, with_alpha(theme.muted, 160), 1.0));
        break;
      case LegendRow::Sign::mark:
        add_refused_mark(frame, {x + 0.4 * em, y}, false, theme);
        break;
      default: {
        PathItem item = line_item({x - 0.2 * em, y}, {x + em, y}, row.colour, 2.0 * theme.line_px);
        if (row.sign == LegendRow::Sign::broken_line) item.stroke.dashes_px = {0.3 * em, 0.3 * em};
        frame.items.emplace_back(std::move(item));
      }
    }
    frame.items.emplace_back(words_item(row, {x + line, y}, theme));
    y += line;
  }
}

}  // namespace sonar
