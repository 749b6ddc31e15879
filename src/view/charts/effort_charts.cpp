// SPDX-License-Identifier: Apache-2.0
#include "view/charts/effort_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "view/colour_bar.h"
#include "view/key_rows.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 14.0;
constexpr double kLeastHeight_em = 9.0;
constexpr double kKeyFrom_em = 18.0;  ///< a lower picture has no key
constexpr double kNormal95 = 1.959964;
constexpr double kHeadroom = 1.06;  ///< of the highest value
constexpr Rgba8 kOfAll{0, 114, 178, 255};
constexpr Rgba8 kOfSchools{213, 94, 0, 255};

Result<void> require_room(PixelSize size, const Theme& theme) {
  if (size.width >= kLeastWidth_em * theme.text_px && size.height >= kLeastHeight_em * theme.text_px) return {};
  return fail(ErrorCode::bad_parameter,
              fmt::format("a picture of {} x {} pixels is too small for a chart", size.width, size.height));
}

double sailed_nmi(std::span<const EffortPlace> places) { return std::max(1e-6, places.back().to_nmi); }

PathItem filled(std::vector<PixelPoint> ring, Rgba8 colour) {
  return polyline_item(std::move(ring), true, {0, 0, 0, 0}, 0.0, colour);
}

/// Where a transect ends and another begins.
void add_transects(EffortChart& chart, std::span<const EffortRow> effort, const Theme& theme) {
  const PixelRect& r = chart.plot.place;
  for (std::size_t i = 0; i < chart.places.size(); ++i) {
    const EffortRow& row = effort[chart.places[i].row];
    const bool begins = i == 0 || effort[chart.places[i - 1].row].transect != row.transect;
    if (!begins) continue;
    std::size_t end = i;
    while (end + 1 < chart.places.size() && effort[chart.places[end + 1].row].transect == row.transect) ++end;
    const double x = chart.plot.at(chart.places[i].from_nmi, chart.plot.y.first).x;
    const double width = chart.plot.at(chart.places[end].to_nmi, chart.plot.y.first).x - x;
    if (i > 0) chart.frame.items.emplace_back(line_item({x, r.y}, {x, r.y + r.height}, theme.axis, theme.line_px));
    const double em = small_text_px(theme, 0.9);
    const std::string name = elided(row.transect, em, width - 0.6 * em);
    if (name.empty()) continue;
    TextItem item = text_item({x + 0.4 * em, r.y + 0.8 * em}, name, em, theme.text);
    item.halo = theme.halo;
    chart.frame.items.emplace_back(std::move(item));
  }
}

struct NascBand {
  double low = kUnknown;
  double high = kUnknown;
};
NascBand band_of(const EffortRow& row) {
  const double off = kNormal95 * row.nasc_se_m2_nmi2;
  return {std::max(0.0, row.nasc_m2_nmi2 - off), row.nasc_m2_nmi2 + off};
}

void add_band(EffortChart& chart, std::span<const EffortRow> effort) {
  for (const EffortPlace& place : chart.places) {
    const NascBand band = band_of(effort[place.row]);
    if (!std::isfinite(band.high)) continue;
    const PixelPoint a = chart.plot.at(place.from_nmi, band.low);
    const PixelPoint b = chart.plot.at(place.to_nmi, band.high);
    chart.frame.items.emplace_back(filled({a, {b.x, a.y}, b, {a.x, b.y}}, with_alpha(kOfAll, 60)));
  }
}

/// A step for each unit; one that is not known breaks the line.
void add_steps(EffortChart& chart, std::span<const EffortRow> effort, double EffortRow::*value, Rgba8 colour,
               double width_px) {
  PathItem path;
  path.stroke = {colour, width_px, {}};
  PathItem::Part part;
  const auto end = [&] {
    if (!part.points.empty()) path.parts.push_back(part);
    part.points.clear();
  };
  for (const EffortPlace& place : chart.places) {
    const double nasc = effort[place.row].*value;
    if (!std::isfinite(nasc)) {
      end();
      continue;
    }
    part.points.push_back(chart.plot.at(place.from_nmi, nasc));
    part.points.push_back(chart.plot.at(place.to_nmi, nasc));
  }
  end();
  if (!path.parts.empty()) chart.frame.items.emplace_back(std::move(path));
}

KeyEntry line_entry(const char* text, Rgba8 colour, const Theme& theme) {
  return {
      text, [colour, &theme](FrameDescription& frame, const PixelRect& swatch) {
        const double y = swatch.y + 0.5 * swatch.height;
        frame.items.emplace_back(line_item({swatch.x, y}, {swatch.x + swatch.width, y}, colour, 2.0 * theme.line_px));
      }};
}

std::vector<KeyEntry> nasc_key(const Theme& theme) {
  return {line_entry("all that was heard", kOfAll, theme),
          {"95 % by fading",
           [](FrameDescription& frame, const PixelRect& swatch) {
             frame.items.emplace_back(rectangle_item(swatch, with_alpha(kOfAll, 60)));
           }},
          line_entry("schools", kOfSchools, theme)};
}

/// Sums over the range bins of a cell.
struct CellSum {
  double sv_volume = 0.0;
  double volume_m3 = 0.0;
};
/// EDSU and depth.
using CellKey = std::tuple<std::string, std::int64_t, double, double>;

std::map<CellKey, CellSum> cell_sums(std::span<const NascRow> nasc, std::optional<double> range_from_m) {
  std::map<CellKey, CellSum> sums;
  for (const NascRow& row : nasc) {
    if (range_from_m && row.range_from_m != *range_from_m) continue;
    CellSum& sum = sums[{row.transect, row.edsu, row.depth_from_m, row.depth_to_m}];
    if (!std::isfinite(row.sv_mean_db) || !(row.volume_m3 > 0.0)) continue;
    sum.sv_volume += linear_from_db(row.sv_mean_db) * row.volume_m3;
    sum.volume_m3 += row.volume_m3;
  }
  return sums;
}

Rgba8 colour_of(double sv_db, const SvColours& colours, const Theme& theme) {
  const double counts = std::round(std::clamp(counts_from_db(sv_db), -32767.0, 32767.0));
  const Rgba8 colour = colours[static_cast<std::int16_t>(counts)];
  return colour.a == 0 ? theme.water : colour;
}

}  // namespace

std::vector<EffortPlace> effort_places(std::span<const EffortRow> effort) {
  std::vector<EffortPlace> places;
  double sailed = 0.0;
  for (std::size_t i = 0; i < effort.size(); ++i) {
    if (effort[i].edsu == 0) continue;
    places.push_back({i, sailed, sailed + effort[i].distance_nmi});
    sailed += effort[i].distance_nmi;
  }
  return places;
}

std::optional<EffortChart::At> EffortChart::at(PixelPoint pixel) const {
  if (!inside(plot.place, pixel)) return std::nullopt;
  const double nmi = plot.x_at(pixel.x);
  for (const EffortPlace& place : places) {
    if (nmi < place.from_nmi || nmi > place.to_nmi || !(place.to_nmi > place.from_nmi)) continue;
    return At{place.row, (nmi - place.from_nmi) / (place.to_nmi - place.from_nmi)};
  }
  return std::nullopt;
}

const EffortChart::Cell* EffortChart::cell(PixelPoint pixel) const {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return inside(c.place, pixel); });
  return found == cells.end() ? nullptr : &*found;
}

Result<EffortChart> nasc_chart(std::span<const EffortRow> effort, PixelSize size, const Theme& theme) {
  if (auto room = require_room(size, theme); !room) return pass_on(room);
  EffortChart chart;
  chart.places = effort_places(effort);
  double most = -1.0;
  for (const EffortPlace& place : chart.places) {
    const EffortRow& row = effort[place.row];
    if (std::isfinite(row.nasc_m2_nmi2)) most = std::max(most, row.nasc_m2_nmi2);
    if (const NascBand band = band_of(row); std::isfinite(band.high)) most = std::max(most, band.high);
  }
  if (most < 0.0) return fail(ErrorCode::not_found, "no unit of sailed distance has a NASC");
  if (most == 0.0) most = 1.0;
  const bool with_key = size.height >= kKeyFrom_em * theme.text_px;
  const std::vector<KeyEntry> key = with_key ? nasc_key(theme) : std::vector<KeyEntry>{};
  LayoutNeeds needs{.colour_bar = false, .y_label_characters = 6, .foot_lines = 0};
  needs.foot_lines = key_lines(key, lay_out(size, theme, needs).plot.width, theme);
  const Layout layout = lay_out(size, theme, needs);
  chart.frame.size = size;
  chart.frame.background = theme.background;
  chart.frame.title = "NASC over sailed distance";
  chart.plot = {layout.plot,
                {0.0, sailed_nmi(chart.places), "sailed on transects (nmi)"},
                {kHeadroom * most, 0.0, "NASC (m\u00B2 nmi\u207B\u00B2)"}};
  chart.frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  add_axes(chart.frame, chart.plot, theme, {true, true});
  chart.frame.items.emplace_back(ClipItem{layout.plot});
  add_band(chart, effort);
  add_steps(chart, effort, &EffortRow::nasc_m2_nmi2, kOfAll, 1.8 * theme.line_px);
  add_steps(chart, effort, &EffortRow::nasc_school_m2_nmi2, kOfSchools, 1.4 * theme.line_px);
  add_transects(chart, effort, theme);
  chart.frame.items.emplace_back(ClipItem{});
  add_title(chart.frame, layout, theme, {chart.frame.title, "of each EDSU, all range bins and depth channels"});
  add_key(chart.frame, layout.foot, key, theme);
  return chart;
}

Result<EffortChart> sv_section(std::span<const EffortRow> effort, std::span<const NascRow> nasc,
                               std::optional<double> range_from_m, const SvColours& colours, PixelSize size,
                               const Theme& theme) {
  if (auto room = require_room(size, theme); !room) return pass_on(room);
  const std::map<CellKey, CellSum> sums = cell_sums(nasc, range_from_m);
  double shallowest = std::numeric_limits<double>::infinity();
  double deepest = -shallowest;
  for (const auto& [key, sum] : sums) {
    if (!(sum.volume_m3 > 0.0)) continue;
    shallowest = std::min(shallowest, std::get<2>(key));
    deepest = std::max(deepest, std::get<3>(key));
  }
  EffortChart chart;
  chart.places = effort_places(effort);
  if (!(deepest > shallowest) || chart.places.empty()) {
    return fail(ErrorCode::not_found, "no EDSU and depth channel has a known Sv");
  }
  const Layout layout = lay_out(size, theme, {.y_label_characters = 5});
  chart.frame.size = size;
  chart.frame.background = theme.background;
  chart.frame.title = "Sv by sailed distance and depth";
  chart.plot = {layout.plot,
                {0.0, sailed_nmi(chart.places), "sailed on transects (nmi)"},
                length_axis(shallowest, deepest, "depth", theme)};
  chart.frame.items.emplace_back(rectangle_item(layout.plot, theme.no_data));
  chart.frame.items.emplace_back(ClipItem{layout.plot});
  std::map<std::pair<std::string, std::int64_t>, std::size_t> place_of;
  for (std::size_t i = 0; i < chart.places.size(); ++i) {
    const EffortRow& row = effort[chart.places[i].row];
    place_of[{row.transect, row.edsu}] = i;
  }
  for (const auto& [key, sum] : sums) {
    const auto& [transect, edsu, from_m, to_m] = key;
    const auto of = place_of.find({transect, edsu});
    if (of == place_of.end() || !(sum.volume_m3 > 0.0)) continue;
    const EffortPlace& place = chart.places[of->second];
    const PixelPoint a = chart.plot.at(place.from_nmi, from_m);
    const PixelPoint b = chart.plot.at(place.to_nmi, to_m);
    const double sv_db = db_from_linear(sum.sv_volume / sum.volume_m3);
    chart.cells.push_back({{a.x, a.y, b.x - a.x, b.y - a.y}, of->second, sv_db, from_m, to_m});
    // A cell in which nothing was heard above the noise is water.
    chart.frame.items.emplace_back(rectangle_item(chart.cells.back().place, colour_of(sv_db, colours, theme)));
  }
  add_transects(chart, effort, theme);
  chart.frame.items.emplace_back(ClipItem{});
  add_axes(chart.frame, chart.plot, theme);
  add_colour_bar(chart.frame, layout.colour_bar, colour_bar(colours), theme);
  const std::string of = range_from_m ? "range bin from " + round_text(*range_from_m, theme.units.length())
                                      : std::string("mean of all range bins, weighted by volume");
  add_title(chart.frame, layout, theme, {chart.frame.title, of});
  return chart;
}

}  // namespace sonar
