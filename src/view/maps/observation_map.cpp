// SPDX-License-Identifier: Apache-2.0
#include "view/maps/observation_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "model/outline.h"
#include "model/school_totals.h"
#include "view/axes.h"
#include "view/maps/graticule.h"
#include "view/maps/map_items.h"
#include "view/maps/observation_map_key.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kMargin = 0.05;  ///< of the hull's size
constexpr double kLeastMargin_m = 30.0;
constexpr double kMostCells = 1000.0;  ///< of the mosaic along a side
constexpr double kShip_m = 78.0;       ///< a large research vessel
constexpr double kLeastShips = 8.0;    ///< lengths that the map shows at least: the ship never fills it

bool has_place(const PingNavigation& n) { return n.has_position() && std::isfinite(n.heading_deg); }

/// A ring about the transducer (x east, y north, m) as places on the map, m.
std::vector<PlanePoint> on_map(const MapProjection& projection, const Geographic& origin, const Ring& ring) {
  std::vector<PlanePoint> out;
  const auto here = projection.forward(origin);
  if (!here) return out;
  const double turned = projection.north_rad(origin);
  const double scale = projection.scale_at(origin);
  const double sine = std::sin(turned) * scale;
  const double cosine = std::cos(turned) * scale;
  for (const PlanePoint& p : ring) {
    out.push_back({here->x + p.x * cosine + p.y * sine, here->y - p.x * sine + p.y * cosine});
  }
  return out;
}

PixelRect map_place(PixelSize size, const Theme& theme, double key_px) {
  const double em = theme.text_px;
  const double left = 7.6 * em;
  const double top = map_top_px(theme);
  return {left, top, size.width - left - 1.4 * em, size.height - top - 2.6 * em - key_px};
}

std::shared_ptr<const Image> painted(const MaskMosaic& mosaic, const MaskPalette& palette) {
  auto image = std::make_shared<Image>(PixelSize{mosaic.width(), mosaic.height()}, Rgba8{0, 0, 0, 0});
  for (std::size_t i = 0; i < image->pixels.size(); ++i) {
    const MaskMosaic::Cell c = mosaic.cells()[i];
    if (c != 0) image->pixels[i] = mask_colour(palette, MaskMosaic::school(c), MaskMosaic::confidence(c));
  }
  return image;
}

void add_current(FrameDescription& frame, const ObservationMapBase& base, const ObservationProduct& product,
                 std::size_t current) {
  const Theme& theme = base.theme;
  if (current >= product.pings.size()) return;
  const PingNavigation& n = product.pings[current];
  if (const auto& ring = base.footprints[current]; ring.size() > 2) {
    frame.items.emplace_back(
        polyline_item(ring, true, theme.accent, 1.6 * theme.line_px, with_alpha(theme.accent, 28)));
  }
  const auto at = n.has_position() ? base.map.at(n.transducer) : std::nullopt;
  if (!at) return;
  const double heading = std::isfinite(n.heading_deg) ? n.heading_deg : n.course_deg;
  const double turned =
      (std::isfinite(heading) ? rad_from_deg(heading) : 0.0) + base.map.projection.north_rad(n.transducer);
  const double length = std::max(kShip_m / base.map.true_metres_per_px(n.transducer), 2.0 * theme.text_px);
  frame.items.emplace_back(ship_item(*at, length, turned, theme.ship, theme.background, theme.line_px));
}

/// Off the ship, and off the water that the beams reached, where schools lie.
void place_scale(ObservationMapBase& base, const std::vector<PingNavigation>& pings) {
  std::vector<PixelPoint> ship;
  std::vector<PixelPoint> water;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    const auto at = pings[i].has_position() ? base.map.at(pings[i].transducer) : std::nullopt;
    if (!at) continue;
    ship.push_back(*at);
    for (const PixelPoint& edge : base.footprints[i]) {
      for (const double t : {0.4, 0.7, 1.0}) {
        water.push_back({at->x + t * (edge.x - at->x), at->y + t * (edge.y - at->y)});
      }
    }
  }
  base.scale = scale_bars(base.map, base.theme, ship, water);
}

}  // namespace

Result<ObservationMapBase> observation_map_base(const ObservationProduct& product, PixelSize size, const Theme& theme,
                                                const MapZoom& zoom, bool key, bool refused,
                                                const PlacementOf& placed) {
  if (size.width < 24.0 * theme.text_px || size.height < 15.0 * theme.text_px) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a map", size.width, size.height));
  }
  std::optional<Sector> sector;
  if (product.grid) sector = product.grid->grid.sector(product.grid->range);
  std::vector<Ring> rings(product.pings.size());
  std::vector<Geographic> shown;
  for (std::size_t i = 0; i < product.pings.size(); ++i) {
    const PingNavigation& n = product.pings[i];
    if (!n.has_position()) continue;
    shown.push_back(n.transducer);
    if (!sector || !has_place(n)) continue;
    rings[i] = footprint(*product.grid, *sector, placed(n));
    for (const PlanePoint& p : rings[i]) shown.push_back(to_geographic(Point<Enu>{p.x, p.y, 0.0}, n.transducer));
  }
  const auto extent = extent_of(shown);
  if (!extent) return fail(ErrorCode::not_found, fmt::format("{}: no ping has a position", product.observation));
  const double size_m =
      geodesic({extent->south_deg, extent->west_deg}, {extent->north_deg, extent->east_deg}).distance_m;
  std::vector<KeyEntry> entries;
  if (key) entries = observation_map_key(product, theme);
  if (key && refused && !product.rejected.empty()) entries.push_back(refused_key(theme));
  const double em = theme.text_px;
  const double key_width = size.width - 2.0 * em;
  const double key_px = key_lines(entries, key_width, theme) * kFootLine_em * em;
  ObservationMapBase base{
      zoomed(fit_map(
                 widened(*extent, std::max({kLeastMargin_m, kMargin * size_m, (kLeastShips * kShip_m - size_m) / 2.0})),
                 map_place(size, theme, key_px)),
             zoom),
      size,
      theme,
      {},
      {},
      {},
      {},
      std::move(entries),
      {em, size.height - 0.5 * em - key_px, key_width, key_px}};
  base.placed = placed;
  base.title = observation_title(product);
  base.track = track_item(base.map, product.pings, {theme.track, 1.6 * theme.line_px, {}});
  const auto first = std::find_if(product.pings.begin(), product.pings.end(),
                                  [](const PingNavigation& n) { return n.has_position(); });
  if (first != product.pings.end()) base.start = base.map.at(first->transducer);
  base.footprints.resize(product.pings.size());
  std::vector<PlanePoint> corners;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (const PlanePoint& p : on_map(base.map.projection, product.pings[i].transducer, rings[i])) {
      corners.push_back(p);
      base.footprints[i].push_back(base.map.at(p));
    }
  }
  for (const PlanePoint& p : convex_hull(std::move(corners))) base.hull.push_back(base.map.at(p));
  place_scale(base, product.pings);
  return base;
}

MaskMosaic empty_mosaic(const ObservationMapBase& base, std::size_t pings) {
  const double longer = std::max(base.map.place.width, base.map.place.height);
  return {base.map, pings, std::max(1.0, std::ceil(longer / kMostCells)), base.placed};
}

MaskMosaic mask_mosaic(const ObservationMapBase& base, const ObservationProduct& product) {
  MaskMosaic mosaic = empty_mosaic(base, product.pings.size());
  if (!product.grid) return mosaic;
  const Sector sector = product.grid->grid.sector(product.grid->range);
  std::vector<std::vector<MosaicMask>> of_ping(product.pings.size());
  for (const SchoolMask& m : product.masks) {
    if (m.ping_index < 0 || m.ping_index >= static_cast<std::int64_t>(of_ping.size())) continue;
    of_ping[static_cast<std::size_t>(m.ping_index)].push_back({static_cast<int>(m.school_id), &m.mask});
  }
  for (std::size_t i = 0; i < of_ping.size(); ++i) {
    if (!of_ping[i].empty()) mosaic.set(i, sector, product.pings[i], of_ping[i]);
  }
  return mosaic;
}

FrameDescription observation_map(const ObservationMapBase& base, const ObservationProduct& product,
                                 const MaskMosaic& mosaic, std::optional<std::size_t> current,
                                 const MaskPalette& palette, std::optional<std::size_t> schools) {
  const Theme& theme = base.theme;
  const std::size_t told = schools.value_or(static_cast<std::size_t>(school_count(product)));
  FrameDescription frame;
  frame.size = base.size;
  frame.background = theme.background;
  frame.title = base.title;
  frame.items.emplace_back(rectangle_item(base.map.place, theme.plot));
  frame.items.emplace_back(ClipItem{base.map.place});
  frame.items.emplace_back(polyline_item(base.hull, true, theme.outline, theme.line_px, theme.water));
  frame.items.emplace_back(ImageItem{
      {base.map.place.x, base.map.place.y, mosaic.width() * mosaic.cell_px(), mosaic.height() * mosaic.cell_px()},
      painted(mosaic, palette),
      false});
  frame.items.emplace_back(base.track);
  if (current) add_current(frame, base, product, *current);
  if (base.start) {
    frame.items.emplace_back(
        circle_item(*base.start, 0.45 * theme.text_px, kStartColour, {theme.text, theme.line_px, {}}));
  }
  frame.items.emplace_back(ClipItem{});
  add_graticule(frame, base.map, theme);
  if (base.scale) add_scale_bars(frame, *base.scale, theme);
  add_north(frame, base.map, theme);
  add_key(frame, base.key_place, base.key, theme);
  const std::string span =
      product.pings.empty() ? std::string() : time_span_text(product.pings.front().time, product.pings.back().time);
  const std::string schools_told =
      base.searched || told > 0 ? schools_text(told, base.left_out) : "schools not detected";
  const std::string count = count_of(product.pings.size(), "ping") + ", " + schools_told;
  std::string ping;
  if (current && *current < product.pings.size()) {
    ping = fmt::format(" · ping {} at {}", *current, clock_text(product.pings[*current].time, true).substr(11));
  }
  // In a narrow map the observation's time goes first, for its days stand in the survey's list, then the ping's.
  std::string line;
  for (const std::string& told_whole : {fmt::format("{} · {}{}", count, span, ping), count + ping, count}) {
    line = told_whole;
    if (text_width_px(line.c_str(), theme.text_px) <= frame.size.width - base.map.place.x) break;
  }
  Layout layout;
  const double em = theme.text_px;
  layout.title = {base.map.place.x, 0.9 * em, base.map.place.width, base.map.place.y - em};
  add_title(frame, layout, theme, {base.title, line});
  return frame;
}

std::vector<PlacedMark> add_map_refused(FrameDescription& frame, const ObservationMapBase& base,
                                        std::span<const RefusedEcho> rows, std::int64_t chosen) {
  std::vector<PlacedMark> marks;
  frame.items.emplace_back(ClipItem{base.map.place});
  for (const RefusedSightings& echo : refused_sightings(rows)) {
    const Geographic place{echo.loudest->latitude, echo.loudest->longitude};
    if (!std::isfinite(place.latitude_deg) || !std::isfinite(place.longitude_deg)) continue;
    const auto at = base.map.at(place);
    if (!at || !inside(base.map.place, *at)) continue;
    marks.push_back({*at, echo.loudest->echo_id});
    add_refused_mark(frame, *at, echo.loudest->echo_id == chosen, base.theme);
  }
  frame.items.emplace_back(ClipItem{});
  return marks;
}

}  // namespace sonar
