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
constexpr double kSecondHead = 0.7;  ///< of a head's length behind the first
constexpr double kDepthGap_m = 20.0;

/// Round in the unit, so that what is told is what is looked up, and no two are told alike; m.
std::vector<double> shown_depths(const CurrentProfiles& profiles, const Unit& unit) {
  std::vector<double> all;
  for (const CurrentProfile& one : profiles) {
    for (const CurrentAt& bin : one.bins) all.push_back(bin.depth_m);
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  std::vector<double> out;
  for (const double share : {0.1, 0.5, 0.9}) {
    const auto rank = static_cast<std::size_t>(std::lround(share * static_cast<double>(all.size() - 1)));
    const double depth_m = std::round(unit.of(all[rank])) * unit.si;
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

/// cut  the water is faster than the arrow is long: two heads
PathItem arrow(PixelPoint from, PixelPoint to, bool cut, double em, Stroke stroke) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double head = std::min(kHead * length, kHead_em * em) / length;
  const double x = (from.x - to.x) * head;
  const double y = (from.y - to.y) * head;
  PathItem item;
  item.stroke = std::move(stroke);
  item.parts.push_back({{from, to}, false});
  const auto add_head = [&](PixelPoint at) {
    item.parts.push_back(
        {{{at.x + x - 0.6 * y, at.y + y + 0.6 * x}, at, {at.x + x + 0.6 * y, at.y + y - 0.6 * x}}, false});
  };
  add_head(to);
  if (cut) add_head({to.x + kSecondHead * x, to.y + kSecondHead * y});
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

/// Empty where nothing is told, or the water has no direction.
std::optional<CurrentAt> current_at_depth(const CurrentProfile& profile, double depth_m) {
  const auto current = current_in(profile, depth_m, kDepthGap_m);
  return current && speed(*current) >= kLeastCurrent_mps ? current : std::nullopt;
}

std::vector<CurrentAt> currents_at(const CurrentProfile& profile, const std::vector<double>& depths) {
  std::vector<CurrentAt> out;
  for (const double depth_m : depths) {
    if (const auto current = current_at_depth(profile, depth_m)) out.push_back(*current);
  }
  return out;
}

/// Far enough from each other to be read, and where arrows of the full length stay inside the map: a part of an arrow would
/// tell a slower current, and some of a place's arrows another one.
std::vector<Placed> placed(const SurveyMapDrawing& d, const CurrentProfiles& profiles,
                           const std::vector<double>& depths) {
  std::vector<Placed> out;
  for (const CurrentProfile& one : profiles) {
    if (!std::isfinite(one.place.latitude_deg) || !std::isfinite(one.place.longitude_deg)) continue;
    const auto at = d.map.at(one.place);
    if (!at || !inside(d.map.place, *at)) continue;
    const bool near = std::any_of(out.begin(), out.end(), [&](const Placed& other) {
      return std::hypot(other.at.x - at->x, other.at.y - at->y) < kApart_em * d.em;
    });
    if (near) continue;
    const Placed here{*at, &one};
    const std::vector<CurrentAt> currents = currents_at(one, depths);
    const bool whole = std::all_of(currents.begin(), currents.end(), [&](const CurrentAt& current) {
      const auto end = tip(d, here, current, kLongest_em * d.em);
      return end && inside(d.map.place, *end);
    });
    if (whole) out.push_back(here);
  }
  return out;
}

}  // namespace

std::string add_currents(const SurveyMapDrawing& d, const CurrentProfiles& profiles) {
  const Unit unit = d.theme.units.length();
  const std::vector<double> depths = shown_depths(profiles, unit);
  const std::vector<Placed> places = placed(d, profiles, depths);
  std::vector<double> speeds_mps;
  for (const Placed& place : places) {
    for (const CurrentAt& one : currents_at(*place.profile, depths)) speeds_mps.push_back(speed(one));
  }
  const double longest_mps = longest_arrow_mps(std::move(speeds_mps));
  std::vector<std::string> told;
  bool any_cut = false;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    const Rgba8 colour = colour_of(k, depths.size());
    std::vector<PixelPoint> ends;
    for (const Placed& place : places) {
      const auto current = current_at_depth(*place.profile, depths[k]);
      if (!current) continue;
      const bool cut = speed(*current) > longest_mps;
      const double length_px = kLongest_em * d.em * (cut ? 1.0 : speed(*current) / longest_mps);
      const auto end = tip(d, place, *current, length_px);
      if (!end) continue;
      d.frame.items.emplace_back(arrow(place.at, *end, cut, d.em, {colour, 1.4 * d.theme.line_px, {}}));
      ends.push_back(*end);
      any_cut = any_cut || cut;
    }
    if (ends.empty()) continue;
    told.push_back(fmt::format("{:.0f}", unit.of(depths[k])));
    // Not the first: there stands the observation's name.
    const PixelPoint& end = ends[ends.size() / 2];
    TextItem name = text_item({end.x, end.y - 0.5 * d.em}, fmt::format("{} {}", told.back(), unit.name),
                              small_text_px(d.theme, 0.8), colour, TextAnchor::centre);
    name.halo = d.theme.halo;
    d.frame.items.emplace_back(std::move(name));
  }
  return told.empty()
             ? std::string{}
             : fmt::format("Arrows: current at {} {} depth, a colour for each; the longest is {}{}",
                           fmt::join(told, ", "), unit.name, quantity_text(longest_mps, 2, d.theme.units.speed()),
                           any_cut ? "; two heads: faster" : "");
}

}  // namespace sonar
