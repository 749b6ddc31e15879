// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_currents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "geo/geodesic.h"
#include "view/colour_map.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kLongest_em = 3.0;
constexpr double kApart_em = 3.5;  ///< between the places of profiles
constexpr double kHead = 0.3;      ///< of an arrow's length, at the most kHead_em
constexpr double kHead_em = 0.6;
constexpr double kLeast_mps = 0.005;  ///< slower water has no direction
constexpr double kDepthGap_m = 20.0;

std::vector<double> shown_depths(const CurrentProfiles& profiles) {
  std::vector<double> all;
  for (const CurrentProfile& one : profiles) {
    for (const CurrentAt& bin : one.bins) all.push_back(bin.depth_m);
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  std::vector<double> out;
  for (const double share : {0.1, 0.5, 0.9}) {
    const double depth_m = std::round(all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))]);
    if (out.empty() || depth_m > out.back()) out.push_back(depth_m);
  }
  return out;
}

/// Dark blue to green: told apart by colour-blind eyes, and from the paper.
Rgba8 colour_of(std::size_t depth, std::size_t depths) {
  const double share = depths > 1 ? static_cast<double>(depth) / static_cast<double>(depths - 1) : 0.0;
  return colour_map(ColourMapName::viridis).at(0.75 * (1.0 - share));
}

struct Placed {
  PixelPoint at;
  const CurrentProfile* profile;
};

/// Far enough from each other to be read.
std::vector<Placed> placed(const SurveyMapDrawing& d, const CurrentProfiles& profiles) {
  std::vector<Placed> out;
  for (const CurrentProfile& one : profiles) {
    if (!std::isfinite(one.place.latitude_deg) || !std::isfinite(one.place.longitude_deg)) continue;
    const auto at = d.map.at(one.place);
    if (!at || !inside(d.map.place, *at)) continue;
    const bool near = std::any_of(out.begin(), out.end(), [&](const Placed& other) {
      return std::hypot(other.at.x - at->x, other.at.y - at->y) < kApart_em * d.em;
    });
    if (!near) out.push_back({*at, &one});
  }
  return out;
}

PathItem arrow(PixelPoint from, PixelPoint to, double em, Stroke stroke) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double head = std::min(kHead * length, kHead_em * em) / length;
  const double x = (from.x - to.x) * head;
  const double y = (from.y - to.y) * head;
  PathItem item;
  item.stroke = std::move(stroke);
  item.parts.push_back({{from, to}, false});
  item.parts.push_back(
      {{{to.x + x - 0.6 * y, to.y + y + 0.6 * x}, to, {to.x + x + 0.6 * y, to.y + y - 0.6 * x}}, false});
  return item;
}

/// Where on the map an arrow of that length ends, in the current's direction there.
std::optional<PixelPoint> tip(const SurveyMapDrawing& d, const Placed& from, const CurrentAt& current,
                              double length_px) {
  constexpr double kAhead_s = 1000.0;  // far enough for pixels, near enough for the map to be flat
  const Geographic there =
      to_geographic(Point<Enu>{current.east_mps * kAhead_s, current.north_mps * kAhead_s, 0.0}, from.profile->place);
  const auto at = d.map.at(there);
  const double way = at ? std::hypot(at->x - from.at.x, at->y - from.at.y) : 0.0;
  if (!(way > 0.0)) return std::nullopt;
  return PixelPoint{from.at.x + (at->x - from.at.x) * length_px / way,
                    from.at.y + (at->y - from.at.y) * length_px / way};
}

double speed(const CurrentAt& current) { return std::hypot(current.east_mps, current.north_mps); }

}  // namespace

std::string add_currents(const SurveyMapDrawing& d, const CurrentProfiles& profiles) {
  const std::vector<Placed> places = placed(d, profiles);
  const std::vector<double> depths = shown_depths(profiles);
  double fastest = 0.0;
  for (const Placed& place : places) {
    for (const double depth_m : depths) {
      if (const auto current = current_in(*place.profile, depth_m, kDepthGap_m))
        fastest = std::max(fastest, speed(*current));
    }
  }
  if (fastest < kLeast_mps) return {};
  const Unit unit = d.theme.units.length();
  std::vector<std::string> told;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    const Rgba8 colour = colour_of(k, depths.size());
    std::vector<PixelPoint> ends;
    for (const Placed& place : places) {
      const auto current = current_in(*place.profile, depths[k], kDepthGap_m);
      if (!current || speed(*current) < kLeast_mps) continue;
      const auto end = tip(d, place, *current, kLongest_em * d.em * speed(*current) / fastest);
      if (!end) continue;
      d.frame.items.emplace_back(arrow(place.at, *end, d.em, {colour, 1.4 * d.theme.line_px, {}}));
      ends.push_back(*end);
    }
    if (ends.empty()) continue;
    told.push_back(fmt::format("{:.0f}", unit.of(depths[k])));
    // Not the first: there stands the observation's name.
    const PixelPoint& end = ends[ends.size() / 2];
    TextItem name = text_item({end.x, end.y - 0.5 * d.em}, fmt::format("{} {}", told.back(), unit.name), 0.8 * d.em,
                              colour, TextAnchor::centre);
    name.halo = d.theme.halo;
    d.frame.items.emplace_back(std::move(name));
  }
  return told.empty() ? std::string{}
                      : fmt::format("Arrows: current at {} {} depth, a colour for each; the longest is {}",
                                    fmt::join(told, ", "), unit.name, quantity_text(fastest, 2, d.theme.units.speed()));
}

}  // namespace sonar
