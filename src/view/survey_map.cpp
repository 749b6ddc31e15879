// SPDX-License-Identifier: Apache-2.0
#include "view/survey_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "view/axes.h"
#include "view/colour_bar.h"
#include "view/depth_layer.h"
#include "view/graticule.h"
#include "view/map_frame.h"
#include "view/map_items.h"
#include "view/school_look.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLegend_em = 17.0;
constexpr double kLeastMargin_m = 150.0;
constexpr int kMostNames = 60;
constexpr Rgba8 kSwept{110, 110, 110, 95};

struct Places {
  PixelRect title;
  PixelRect map;
  PixelRect legend;
};

Places places(PixelSize size, const Theme& theme, double left_em, bool legend) {
  const double em = theme.text_px;
  const double legend_em = legend ? kLegend_em : 0.0;
  const double top = 1.6 * em + 1.5 * theme.title_px + 1.1 * em;
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

struct Drawing {
  FrameDescription& frame;
  const MapFrame& map;
  const Theme& theme;
  const SchoolLook& look;
  double em;
};

double area_px2(const PathItem& item) {
  double sum = 0.0;
  for (const PathItem::Part& part : item.parts) {
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const PixelPoint& a = part.points[i];
      const PixelPoint& b = part.points[(i + 1) % part.points.size()];
      sum += (a.x * b.y - b.x * a.y) / 2.0;
    }
  }
  return std::abs(sum);
}

void add_school(const Drawing& d, const SchoolRow& school, const ObservationOutlines* outlines) {
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
  const double radius = d.look.radius_px(school.backscatter_m2);
  const bool hides = area > 12.0 && area > 0.25 * 3.14 * radius * radius;
  d.frame.items.emplace_back(circle_item(*centre, radius, hides ? Rgba8{0, 0, 0, 0} : with_alpha(colour, 215),
                                         {d.theme.text, 0.8 * d.theme.line_px, {}}));
}

void add_start(const Drawing& d, const ObservationProduct& product) {
  const auto first =
      std::find_if(product.pings.begin(), product.pings.end(), [](const auto& n) { return n.has_position(); });
  if (first == product.pings.end()) return;
  const auto at = d.map.at(first->transducer);
  if (!at) return;
  d.frame.items.emplace_back(circle_item(*at, 0.5 * d.em, kStartColour, {d.theme.text, d.theme.line_px, {}}));
}

/// Beside the start's marker, away from where the ship went as long as it fits there.
std::optional<TextItem> start_name(const Drawing& d, const ObservationProduct& product) {
  const auto first =
      std::find_if(product.pings.begin(), product.pings.end(), [](const auto& n) { return n.has_position(); });
  if (first == product.pings.end()) return std::nullopt;
  const auto at = d.map.at(first->transducer);
  if (!at) return std::nullopt;
  const auto after = std::find_if(first, product.pings.end(), [&](const auto& n) {
    return n.has_position() && geodesic(first->transducer, n.transducer).distance_m > 20.0;
  });
  const auto next = after != product.pings.end() ? d.map.at(after->transducer) : std::nullopt;
  bool to_left = next && next->x > at->x;
  const double reach = 1.1 * d.em + text_width_px(product.observation.c_str(), 0.9 * d.em);
  const bool fits_left = at->x - reach > d.map.place.x;
  const bool fits_right = at->x + reach < d.map.place.x + d.map.place.width;
  if (to_left ? !fits_left && fits_right : !fits_right && fits_left) to_left = !to_left;
  const double low = d.map.place.y + 0.8 * d.em;
  const double y = std::clamp(at->y, low, std::max(low, d.map.place.y + d.map.place.height - 0.8 * d.em));
  TextItem name = text_item({at->x + (to_left ? -0.9 : 0.9) * d.em, y}, product.observation, 0.9 * d.em, d.theme.text,
                            to_left ? TextAnchor::right : TextAnchor::left);
  name.halo = d.theme.halo;
  return name;
}

/// "depth.tif (elevation, negative down)": how the sign was told, and a variable of the same name, say nothing more.
std::string brief_source(std::string source) {
  if (const auto why = source.rfind(" (told by "); why != std::string::npos) source.resize(why);
  const auto colon = source.rfind(": ");
  if (colon == std::string::npos) return source;
  std::string head = source.substr(0, colon);
  const std::string meaning = source.substr(colon + 2);
  if (const auto comma = head.rfind(", "); comma != std::string::npos && meaning.starts_with(head.substr(comma + 2))) {
    head.resize(comma);
  }
  return head + " (" + meaning + ")";
}

void add_ship(const Drawing& d, std::span<const ObservationProduct> observations) {
  const PingNavigation* last = nullptr;
  for (const ObservationProduct& product : observations) {
    for (const PingNavigation& n : product.pings) {
      if (n.has_position() && (last == nullptr || n.time >= last->time)) last = &n;
    }
  }
  if (last == nullptr) return;
  const auto at = d.map.at(last->transducer);
  if (!at) return;
  const double heading = std::isfinite(last->heading_deg) ? last->heading_deg : last->course_deg;
  const double turned =
      (std::isfinite(heading) ? rad_from_deg(heading) : 0.0) + d.map.projection.north_rad(last->transducer);
  d.frame.items.emplace_back(ship_item(*at, 2.2 * d.em, turned, d.theme.ship, d.theme.background, d.theme.line_px));
}

/// What the legend says below its colour bars, line by line.
class Legend {
 public:
  Legend(const Drawing& d, const PixelRect& place, double y) : d_(d), place_(place), y_(y) {}

  [[nodiscard]] PixelPoint symbol() const { return {place_.x + 1.1 * d_.em, y_}; }
  [[nodiscard]] bool full() const { return y_ > place_.y + place_.height - 0.6 * d_.em; }
  void text(const std::string& words) {
    d_.frame.items.emplace_back(text_item({place_.x + 2.8 * d_.em, y_}, words, d_.em, d_.theme.text));
    y_ += 1.6 * d_.em;
  }
  void small(const std::string& words) {
    const double size = 0.82 * d_.em;
    for (const std::string& line : wrapped(words, place_.width, size)) {
      if (full()) return;
      d_.frame.items.emplace_back(text_item({place_.x, y_}, line, size, d_.theme.muted));
      y_ += 1.25 * size;
    }
    y_ += 0.5 * d_.em;
  }
  void gap() { y_ += 0.5 * d_.em; }

 private:
  const Drawing& d_;
  PixelRect place_;
  double y_;
};

void add_sizes(const Drawing& d, Legend& legend, const SurveyMapStyle& style) {
  const std::vector<double> sizes = d.look.sizes();
  const Rgba8 fill = style.colouring == SchoolColouring::mean_sv ? d.look.map().at(0.6) : d.theme.muted;
  for (const double size : sizes) {
    if (legend.full()) return;
    d.frame.items.emplace_back(circle_item(legend.symbol(), d.look.radius_px(size), with_alpha(fill, 205),
                                           {d.theme.text, 0.8 * d.theme.line_px, {}}));
    legend.text(fmt::format("{:g} m² backscatter", size));
  }
}

void add_symbols(const Drawing& d, Legend& legend, const SurveyMapStyle& style) {
  const double em = d.em;
  const auto at = [&] { return legend.symbol(); };
  d.frame.items.emplace_back(
      ship_item(at(), 1.9 * em, 0.5 * 3.14159, d.theme.ship, d.theme.background, d.theme.line_px));
  legend.text("ship, last position");
  d.frame.items.emplace_back(
      line_item({at().x - em, at().y}, {at().x + em, at().y}, d.theme.track, 1.6 * d.theme.line_px));
  legend.text("ship's track");
  d.frame.items.emplace_back(circle_item(at(), 0.5 * em, kStartColour, {d.theme.text, d.theme.line_px, {}}));
  legend.text("start of an observation");
  if (style.swept) {
    d.frame.items.emplace_back(rectangle_item({at().x - em, at().y - 0.55 * em, 2.0 * em, 1.1 * em}, kSwept));
    legend.text("search volume");
  }
  for (const auto& [colour, name] : d.look.entries()) {
    if (legend.full()) return;
    d.frame.items.emplace_back(rectangle_item({at().x - em, at().y - 0.45 * em, 2.0 * em, 0.9 * em}, colour,
                                              d.theme.text, 0.8 * d.theme.line_px));
    legend.text(name);
  }
}

void add_legend(const Drawing& d, const PixelRect& place, const DepthBands& bands, const SurveyMapStyle& style,
                const DepthGrid* depths, bool schools, const std::string& note) {
  const double em = d.em;
  const double height = std::clamp(0.3 * place.height, 6.0 * em, 15.0 * em);
  double x = place.x + 0.4 * em;
  const double y = place.y + 1.8 * em;
  bool bars = false;
  if (schools && style.colouring == SchoolColouring::mean_sv) {
    add_colour_bar(d.frame, {x, y, 1.3 * em, height}, d.look.map(), style.sv_low_db, style.sv_high_db, d.theme,
                   "mean Sv (dB)");
    x += 8.4 * em;
    bars = true;
  }
  if (bands.levels_m.size() > 1) {
    add_colour_bar(d.frame, {x, y, 1.3 * em, height}, bands.map, bands.levels_m.front(), bands.levels_m.back(), d.theme,
                   "depth (m)", true);
    bars = true;
  }
  Legend legend(d, place, bars ? y + height + 2.2 * em : place.y + em);
  add_symbols(d, legend, style);
  if (bands.land) {
    d.frame.items.emplace_back(
        rectangle_item({legend.symbol().x - em, legend.symbol().y - 0.55 * em, 2.0 * em, 1.1 * em}, d.theme.land,
                       d.theme.text, 0.5 * d.theme.line_px));
    legend.text("land");
  }
  add_sizes(d, legend, style);
  legend.gap();
  legend.small(d.map.projection.name());
  if (depths != nullptr) {
    legend.small("Depths: " + brief_source(depths->source));
    if (bands.levels_m.empty()) legend.small("The raster has no depths here.");
    if (bands.unknown && !bands.levels_m.empty()) legend.small("Plain where the raster has no depths.");
  } else {
    legend.small("No depth raster: plain sea.");
  }
  if (!note.empty()) legend.small(note);
}

std::string second_line(std::span<const ObservationProduct> observations, const SchoolLook& look) {
  TimeNs first = 0;
  TimeNs last = 0;
  std::int64_t schools = 0;
  for (const ObservationProduct& product : observations) {
    schools +=
        std::count_if(product.schools.begin(), product.schools.end(), [&](const auto& s) { return look.shown(s); });
    if (product.pings.empty()) continue;
    first = first == 0 ? product.pings.front().time : std::min(first, product.pings.front().time);
    last = std::max(last, product.pings.back().time);
  }
  return fmt::format("{} observation{}, {} school{} · {}", observations.size(), observations.size() == 1 ? "" : "s",
                     schools, schools == 1 ? "" : "s", time_span_text(first, last));
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
  if (size.width < (style.legend ? 40.0 : 23.0) * theme.text_px || size.height < 22.0 * theme.text_px) {
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
  const Drawing d{frame, map, theme, look, theme.text_px};
  frame.items.emplace_back(rectangle_item(map.place, theme.plot));
  DepthBands bands;
  std::vector<TextItem> names;
  std::vector<PixelPoint> taken;
  if (style.names && observations.size() <= kMostNames) {
    for (const ObservationProduct& product : observations) {
      auto name = start_name(d, product);
      if (!name) continue;
      taken.push_back(name->at);
      names.push_back(std::move(*name));
    }
  }
  if (depths != nullptr) bands = add_depth_layer(frame, map, *depths, theme, taken);
  frame.items.emplace_back(ClipItem{map.place});
  bool schools = false;
  for (const ObservationProduct& product : observations) {
    const ObservationOutlines* o = outlines_of(outlines, product.observation);
    if (style.swept && o != nullptr)
      frame.items.emplace_back(area_item(map, o->swept, kSwept, {{0, 0, 0, 0}, 0.0, {}}));
    schools = schools || !product.schools.empty();
  }
  for (const ObservationProduct& product : observations) {
    frame.items.emplace_back(track_item(map, product.pings, {theme.track, 1.6 * theme.line_px, {}}));
  }
  for (const ObservationProduct& product : observations) {
    const ObservationOutlines* o = outlines_of(outlines, product.observation);
    for (const SchoolRow& school : product.schools) {
      if (look.shown(school)) add_school(d, school, o);
    }
  }
  // A start may lie below the ship: it stays seen.
  add_ship(d, observations);
  for (const ObservationProduct& product : observations) add_start(d, product);
  for (TextItem& name : names) frame.items.emplace_back(std::move(name));
  frame.items.emplace_back(ClipItem{});
  add_graticule(frame, map, theme);
  add_scale_and_north(frame, map, theme);
  if (style.legend) add_legend(d, p.legend, bands, style, depths, schools, note);
  Layout layout;
  layout.title = p.title;
  add_title(frame, layout, theme, {frame.title, second_line(observations, look)});
  return frame;
}

}  // namespace sonar
