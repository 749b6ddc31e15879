// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "view/axes.h"
#include "view/maps/depth_layer.h"
#include "view/maps/graticule.h"
#include "view/maps/map_frame.h"
#include "view/maps/map_items.h"
#include "view/maps/survey_map_currents.h"
#include "view/maps/survey_map_labels.h"
#include "view/maps/survey_map_legend.h"
#include "view/maps/survey_map_transects.h"
#include "view/school_labels.h"
#include "view/school_look.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLegend_em = 17.0;
constexpr double kLeastMargin_m = 150.0;
constexpr int kMostNames = 60;
constexpr double kSpeck_em = 1.2;  ///< side of the largest hole in a search volume that the picture has no use for

struct Places {
  PixelRect title;
  PixelRect map;
  PixelRect legend;
};

Places places(PixelSize size, const Theme& theme, double left_em, bool legend) {
  const double em = theme.text_px;
  const double legend_em = legend ? kLegend_em : 0.0;
  const double top = map_top_px(theme);
  Places p;
  p.map = {left_em * em, top, size.width - (left_em + legend_em + 2.2) * em, size.height - top - 2.6 * em};
  p.title = {p.map.x, 0.9 * em, size.width - p.map.x - em, top - em};
  p.legend = {p.map.x + p.map.width + 1.4 * em, top, legend_em * em, p.map.height};
  return p;
}

/// The map as large as it goes, with room for its labels on the left.
MapFrame laid_out(const GeoExtent& extent, const SurveyMapStyle& style, PixelSize size, const Theme& theme, Places& p) {
  p = places(size, theme, 6.5, style.legend);
  const MapFrame map = zoomed(fit_map(extent, p.map), style.zoom);
  double widest = 0.0;
  for (const auto& label : graticule(map, 11.0 * theme.text_px).latitudes) {
    widest = std::max(widest, text_width_px(label.text.c_str(), 1.0));
  }
  p = places(size, theme, widest + 1.2, style.legend);
  return zoomed(fit_map(extent, p.map), style.zoom);
}

const ObservationOutlines* outlines_of(std::span<const ObservationOutlines> outlines, const std::string& name) {
  const auto found =
      std::find_if(outlines.begin(), outlines.end(), [&](const auto& o) { return o.observation == name; });
  return found != outlines.end() ? &*found : nullptr;
}

/// Positive or negative as it turns.
double area_px2(const PathItem::Part& part) {
  double sum = 0.0;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const PixelPoint& a = part.points[i];
    const PixelPoint& b = part.points[(i + 1) % part.points.size()];
    sum += (a.x * b.y - b.x * a.y) / 2.0;
  }
  return sum;
}

double area_px2(const PathItem& item) {
  double sum = 0.0;
  for (const PathItem::Part& part : item.parts) sum += area_px2(part);
  return std::abs(sum);
}

/// Between the footprints of pings made far apart there are slits and specks of a few pixels along the edge, which look
/// like a perforation and say nothing at the map's scale.
void drop_specks(PathItem& area, double most_px2) {
  const bool all_small = std::all_of(area.parts.begin(), area.parts.end(),
                                     [&](const PathItem::Part& part) { return std::abs(area_px2(part)) < most_px2; });
  if (all_small) return;
  std::erase_if(area.parts, [&](const PathItem::Part& part) { return std::abs(area_px2(part)) < most_px2; });
}

void add_school(const SurveyMapDrawing& d, const SchoolRow& school, const ObservationOutlines* outlines) {
  const Rgba8 colour = d.look.colour(school);
  const Stroke edge{d.theme.text, 0.8 * d.theme.line_px, status_dashes(school.status, d.theme)};
  double area = 0.0;
  if (outlines != nullptr) {
    for (const auto& o : outlines->schools) {
      if (o.school_id != school.school_id) continue;
      PathItem item = area_item(d.map, o.area, colour, edge);
      area += area_px2(item);
      if (!item.parts.empty()) d.frame.items.emplace_back(std::move(item));
    }
  }
  if (!std::isfinite(school.latitude) || !std::isfinite(school.longitude)) return;
  const auto centre = d.map.at(Geographic{school.latitude, school.longitude});
  if (!centre) return;
  // Where the outline can be seen the circle must not hide it.
  const double radius = d.look.radius_px(d.look.backscatter_m2(school));
  const bool hides = area > 12.0 && area > 0.25 * 3.14 * radius * radius;
  d.frame.items.emplace_back(circle_item(*centre, radius, hides ? Rgba8{0, 0, 0, 0} : with_alpha(colour, 215),
                                         {d.theme.text, 0.8 * d.theme.line_px, {}}));
}

void add_start(const SurveyMapDrawing& d, const ObservationProduct& product) {
  const auto at = start_on_map(d, product);
  if (!at) return;
  d.frame.items.emplace_back(circle_item(*at, 0.5 * d.em, kStartColour, {d.theme.text, d.theme.line_px, {}}));
}

/// The last ping with a position; nullptr = none.
const PingNavigation* last_placed(std::span<const ObservationProduct> observations) {
  const PingNavigation* last = nullptr;
  for (const ObservationProduct& product : observations) {
    for (const PingNavigation& n : product.pings) {
      if (n.has_position() && (last == nullptr || n.time >= last->time)) last = &n;
    }
  }
  return last;
}

void add_ship(const SurveyMapDrawing& d, const PingNavigation& last, PixelPoint at) {
  const double heading = std::isfinite(last.heading_deg) ? last.heading_deg : last.course_deg;
  const double turned =
      (std::isfinite(heading) ? rad_from_deg(heading) : 0.0) + d.map.projection.north_rad(last.transducer);
  d.frame.items.emplace_back(ship_item(at, 2.2 * d.em, turned, d.theme.ship, d.theme.background, d.theme.line_px));
}

/// Where the ship was, and the schools that are shown.
std::vector<PixelPoint> symbols(const MapFrame& map, std::span<const ObservationProduct> observations,
                                const SchoolLook& look) {
  std::vector<PixelPoint> out;
  const auto add = [&](const Geographic& place) {
    if (!std::isfinite(place.latitude_deg) || !std::isfinite(place.longitude_deg)) return;
    if (const auto at = map.at(place)) out.push_back(*at);
  };
  for (const ObservationProduct& product : observations) {
    for (const PingNavigation& n : product.pings) add(n.transducer);
    for (const SchoolRow& school : product.schools) {
      if (look.shown(school)) add({school.latitude, school.longitude});
    }
  }
  return out;
}

std::string second_line(std::span<const ObservationProduct> observations, const SchoolLook& look,
                        const SurveyMapStyle& style) {
  const int unsearched = style.unsearched;
  TimeNs first = 0;
  TimeNs last = 0;
  const std::size_t schools = look.schools();
  for (const ObservationProduct& product : observations) {
    if (product.pings.empty()) continue;
    first = first == 0 ? product.pings.front().time : std::min(first, product.pings.front().time);
    last = std::max(last, product.pings.back().time);
  }
  const auto all = static_cast<std::int64_t>(observations.size());
  std::string told = schools_text(schools, style.left_out);
  if (unsearched >= all && schools == 0) {
    told = "schools not detected";
  } else if (unsearched > 0) {
    told += fmt::format(" (not detected in {} of them)", unsearched);
  }
  return fmt::format("{}, {} · {}", count_of(static_cast<std::size_t>(all), "observation"), told,
                     time_span_text(first, last));
}

}  // namespace

std::optional<GeoExtent> survey_extent(std::span<const ObservationProduct> observations,
                                       std::span<const ObservationOutlines> outlines, double margin) {
  std::vector<Geographic> shown;
  for (const ObservationProduct& product : observations) {
    for (const PingNavigation& n : product.pings) {
      if (n.has_position()) shown.push_back(n.transducer);
    }
  }
  if (shown.empty()) return std::nullopt;
  for (const ObservationOutlines& o : outlines) {
    for (const auto& ring : o.swept.rings) shown.insert(shown.end(), ring.begin(), ring.end());
  }
  const auto extent = extent_of(shown);
  if (!extent) return std::nullopt;
  const double size_m =
      geodesic({extent->south_deg, wrap_180(extent->west_deg)}, {extent->north_deg, wrap_180(extent->east_deg)})
          .distance_m;
  return widened(*extent, std::max(kLeastMargin_m, margin * size_m));
}

std::optional<GeoExtent> survey_map_extent(std::span<const ObservationProduct> observations,
                                           std::span<const ObservationOutlines> outlines, const SurveyMapStyle& style,
                                           PixelSize size, const Theme& theme) {
  const auto extent = survey_extent(observations, outlines, style.margin);
  if (!extent) return std::nullopt;
  Places p;
  return shown_extent(laid_out(*extent, style, size, theme, p));
}

std::optional<MapFrame> survey_chart(std::span<const ObservationProduct> observations,
                                     std::span<const ObservationOutlines> outlines, const SurveyMapStyle& style,
                                     PixelSize size, const Theme& theme) {
  const auto extent = survey_extent(observations, outlines, style.margin);
  if (!extent) return std::nullopt;
  Places p;
  return laid_out(*extent, style, size, theme, p);
}

Result<FrameDescription> survey_map(std::span<const ObservationProduct> observations,
                                    std::span<const ObservationOutlines> outlines, const DepthGrid* depths,
                                    const SurveyMapStyle& style, PixelSize size, const Theme& theme,
                                    const std::string& note) {
  if (auto ok = validate(style); !ok) return pass_on(ok);
  const auto extent = survey_extent(observations, outlines, style.margin);
  if (!extent) return fail(ErrorCode::not_found, "no ping of the survey has a position: there is nothing to map");
  if (size.width < (style.legend ? 40.0 : 23.0) * theme.text_px ||
      size.height < (style.legend ? 22.0 : 15.0) * theme.text_px) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a survey map", size.width, size.height));
  }
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = survey_title(observations);
  Places p;
  const MapFrame map = laid_out(*extent, style, size, theme, p);
  const SchoolLook look(observations, style, theme);
  const SurveyMapDrawing d{frame, map,           theme,
                           look,  theme.text_px, scale_bars(map, theme, symbols(map, observations, look))};
  frame.items.emplace_back(rectangle_item(map.place, theme.plot));
  DepthBands bands;
  const PingNavigation* last = last_placed(observations);
  const auto ship = last != nullptr ? map.at(last->transducer) : std::nullopt;
  StartNames names;
  if (style.names && observations.size() <= kMostNames) names = start_names(d, observations, ship);
  std::vector<PixelPoint> taken;
  for (const TextItem& name : names.names) taken.push_back(name.at);
  if (d.scale) {
    const PixelRect& box = d.scale->place;
    for (double x = box.x; x < box.x + box.width + d.em; x += 5.0 * d.em)
      taken.push_back({x, box.y + box.height / 2.0});
  }
  if (depths != nullptr) bands = add_depth_layer(frame, map, *depths, theme, taken);
  frame.items.emplace_back(ClipItem{map.place});
  bool schools = false;
  for (const ObservationProduct& product : observations) {
    const ObservationOutlines* o = outlines_of(outlines, product.observation);
    if (style.swept && o != nullptr) {
      PathItem swept = area_item(map, o->swept, kSweptColour, {{0, 0, 0, 0}, 0.0, {}});
      drop_specks(swept, kSpeck_em * kSpeck_em * d.em * d.em);
      frame.items.emplace_back(std::move(swept));
    }
    schools = schools || !product.schools.empty();
  }
  add_transects(d, observations, style);
  for (const ObservationProduct& product : observations) {
    frame.items.emplace_back(track_item(map, product.pings, {theme.track, 1.6 * theme.line_px, {}}));
  }
  const std::string currents = style.currents ? add_currents(d, *style.currents) : std::string{};
  // A school may lie where the ship ended: it is what the map is for, and stays seen.
  if (ship) add_ship(d, *last, *ship);
  for (const ObservationProduct& product : observations) {
    const ObservationOutlines* o = outlines_of(outlines, product.observation);
    for (const SchoolRow& school : product.schools) {
      if (look.shown(school)) add_school(d, school, o);
    }
  }
  for (const ObservationProduct& product : observations) add_start(d, product);
  for (TextItem& name : transect_names(d, observations, style)) names.names.push_back(std::move(name));
  const auto left_out = add_numbers(d, observations, names.names, ship);
  std::move(names.leaders.begin(), names.leaders.end(), std::back_inserter(frame.items));
  for (TextItem& name : names.names) frame.items.emplace_back(std::move(name));
  frame.items.emplace_back(ClipItem{});
  add_graticule(frame, map, theme);
  if (d.scale) add_scale_bars(frame, *d.scale, theme);
  add_north(frame, map, theme);
  if (style.legend)
    add_survey_legend(
        d, p.legend, bands, style, depths, schools,
        {left_out_text(left_out), left_out_text(names.left_out, "names"), transects_text(style), currents, note});
  if (!theme.bars) frame.bars = survey_bars(d, bands, style, schools);
  Layout layout;
  layout.title = p.title;
  add_title(frame, layout, theme, {frame.title, second_line(observations, look, style)});
  return frame;
}

}  // namespace sonar
