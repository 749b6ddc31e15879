// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_transects.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kBreadth = 6.0;    ///< of the lines, over that of thin ones
constexpr double kBeside_em = 0.8;  ///< names stand so far to the right of a track
constexpr std::uint8_t kAlpha = 150;

/// Number of a stratum among those of the transects, from 1.
int number_of(const std::string& stratum, std::span<const Transect> transects) {
  std::vector<std::string> seen;
  for (const Transect& one : transects) {
    if (one.type != EffortType::transect || std::find(seen.begin(), seen.end(), one.stratum) != seen.end()) continue;
    seen.push_back(one.stratum);
    if (one.stratum == stratum) break;
  }
  return static_cast<int>(seen.size());
}

/// Pings of an observation within a period.
std::span<const PingNavigation> pings_of(const ObservationProduct& observation, const Transect& period) {
  const auto earlier = [](const PingNavigation& ping, TimeNs time) { return ping.time < time; };
  const auto later = [](TimeNs time, const PingNavigation& ping) { return time < ping.time; };
  const auto first = std::lower_bound(observation.pings.begin(), observation.pings.end(), period.start_utc, earlier);
  return {first, std::upper_bound(first, observation.pings.end(), period.stop_utc, later)};
}

void add_line(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations, const Transect& period,
              Rgba8 colour) {
  for (const ObservationProduct& observation : observations) {
    PathItem line = track_item(d.map, pings_of(observation, period), {colour, kBreadth * d.theme.line_px, {}});
    if (!line.parts.empty()) d.frame.items.emplace_back(std::move(line));
  }
}

/// Where on the map the middle of what is seen of a transect lies.
std::optional<PixelPoint> middle_of(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                                    const Transect& transect) {
  std::vector<PixelPoint> places;
  for (const ObservationProduct& observation : observations) {
    for (const PingNavigation& ping : pings_of(observation, transect)) {
      const auto at = ping.has_position() ? d.map.at(ping.transducer) : std::nullopt;
      if (at) places.push_back(*at);
    }
  }
  return places.empty() ? std::nullopt : std::optional(places[places.size() / 2]);
}

}  // namespace

void add_transects(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                   const SurveyMapStyle& style) {
  for (const Transect& one : style.transects) {
    if (one.type != EffortType::transect) continue;
    add_line(d, observations, one, with_alpha(school_colour(number_of(one.stratum, style.transects)), kAlpha));
  }
  for (const Transect& one : style.transects) {
    if (one.type == EffortType::off) add_line(d, observations, one, d.theme.muted);
  }
}

std::vector<TextItem> transect_names(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                                     const SurveyMapStyle& style) {
  std::vector<TextItem> names;
  for (const Transect& one : style.transects) {
    const auto at = one.type == EffortType::transect ? middle_of(d, observations, one) : std::nullopt;
    if (!at) continue;
    names.push_back(text_item({at->x + kBeside_em * d.em, at->y}, one.name, small_text_px(d.theme, 0.9), d.theme.text,
                              TextAnchor::left));
    names.back().halo = d.theme.halo;
  }
  return names;
}

std::string transects_text(const SurveyMapStyle& style) {
  return style.transects.empty() ? std::string{}
                                 : "Broad lines: transects, a colour for each stratum; grey: off effort";
}

}  // namespace sonar
