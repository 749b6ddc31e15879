// SPDX-License-Identifier: Apache-2.0
#include "publish/frequency_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "model/strongest_ping.h"
#include "publish/volumes/drawn_schools.h"

namespace sonar {
namespace {

constexpr double kWaterAlpha = 150.0 / 255.0;  ///< of a school's colour, towards the background

Rgba8 paler(Rgba8 colour, const Theme& theme) {
  const auto mix = [](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(kWaterAlpha * a + (1.0 - kWaterAlpha) * b + 0.5);
  };
  return {mix(colour.r, theme.muted.r), mix(colour.g, theme.muted.g), mix(colour.b, theme.muted.b), 255};
}

std::vector<FrequencyPoint> points_of(const std::vector<std::vector<HeardFan>>& pings,
                                      std::span<const double> frequency_hz) {
  std::vector<FrequencyPoint> points;
  for (const FanResponse& fan : fan_response(pings)) {
    points.push_back({fan.fan, frequency_hz[static_cast<std::size_t>(fan.fan)] / 1000.0, fan.sv_mean_db, fan.sv_p25_db,
                      fan.sv_p75_db, fan.pings, fan.samples, fan.volume_m3});
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const FrequencyPoint& a, const FrequencyPoint& b) { return a.frequency_khz < b.frequency_khz; });
  return points;
}

/// The schools that are asked for; without any that in whose strongest ping a picture of the observation is.
std::vector<std::int64_t> chosen_schools(const DrawnObservation& observation, const PictureOptions& options) {
  if (!options.schools.empty()) return options.schools;
  const ObservationProduct& product = observation.product();
  const SchoolPingRow* strongest =
      strongest_ping(product, [&](const SchoolRow& school) { return wanted(product, school.school_id, options); });
  return strongest == nullptr ? std::vector<std::int64_t>{} : std::vector{strongest->school_id};
}

/// Pings with a mask of one of the schools, rising.
std::set<std::int64_t> pings_of(const ObservationProduct& product, const std::vector<std::int64_t>& schools) {
  std::set<std::int64_t> pings;
  for (const SchoolMask& one : product.masks) {
    if (std::find(schools.begin(), schools.end(), one.school_id) != schools.end()) pings.insert(one.ping_index);
  }
  return pings;
}

}  // namespace

Result<void> require_fan_frequencies(const std::string& observation, std::span<const double> frequency_hz, int fans) {
  const std::set<double> different(frequency_hz.begin(), frequency_hz.end());
  if (frequency_hz.size() == static_cast<std::size_t>(fans) && different.size() > 1) return {};
  return fail(ErrorCode::not_found, "the fans of " + observation + " have no frequencies of their own to compare");
}

void SchoolFans::add(const PingMask& mask, std::span<const PingMask* const> masks, const StagedPing& ping,
                     const Sector& sector) {
  school.push_back(heard_fans(mask, ping, sector));
  water.push_back(heard_fans(water_round(mask, masks, ping, sector), ping, sector));
}

void SchoolFans::add(const SchoolFans& more) {
  school.insert(school.end(), more.school.begin(), more.school.end());
  water.insert(water.end(), more.water.begin(), more.water.end());
}

std::vector<FrequencySeries> frequency_series(const SchoolFans& fans, const std::string& name, Rgba8 colour,
                                              const Theme& theme, std::span<const double> frequency_hz, bool water) {
  std::vector<FrequencySeries> out;
  if (water) out.push_back({"water round " + name, paler(colour, theme), true, points_of(fans.water, frequency_hz)});
  out.push_back({name, colour, false, points_of(fans.school, frequency_hz)});
  return out;
}

Result<FrameDescription> frequency_frame(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  if (!observation.has_raw()) {
    return fail(ErrorCode::not_found,
                "frequencies are of samples: name the raw files of " + observation.name() + " too");
  }
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  if (auto known = require_fan_frequencies(observation.name(), observation.frequency_hz(), sector->fans()); !known) {
    return pass_on(known);
  }
  const std::vector<std::int64_t> schools = chosen_schools(observation, options);
  std::set<std::int64_t> pings = pings_of(observation.product(), schools);
  if (pings.empty()) return fail(ErrorCode::not_found, "there are no schools to compare over frequency");
  const FrequencyParams& asked = options.kind.frequency;
  if (asked.one_ping) {
    const auto index = chosen_ping(observation, options);
    if (!index) return pass_on(index);
    pings = {*index};
  }
  std::map<std::int64_t, SchoolFans> fans;
  std::int64_t done = 0;
  for (const std::int64_t index : pings) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto ping = observation.ping(index, work);
    if (!ping) return pass_on(ping);
    std::vector<const PingMask*> masks;
    for (const DrawnMask& one : ping->masks) masks.push_back(one.mask.get());
    for (const DrawnMask& one : ping->masks) {
      if (std::find(schools.begin(), schools.end(), one.school_id) == schools.end()) continue;
      fans[one.school_id].add(*one.mask, masks, *ping->staged, *sector);
    }
    work.progress("frequencies", ++done, static_cast<std::int64_t>(pings.size()));
  }
  const Theme theme = theme_of(options);
  FrequencyChartData data;
  data.title = observation.title() + ": schools over frequency";
  data.pings = asked.one_ping
                   ? fmt::format("ping {}", *pings.begin())
                   : fmt::format("{} from {} to {}", count_of(pings.size(), "ping"), *pings.begin(), *pings.rbegin());
  for (const auto& [id, heard] : fans) {
    for (FrequencySeries& one :
         frequency_series(heard, fmt::format("school {}", id), school_colour(static_cast<int>(id)), theme,
                          observation.frequency_hz(), asked.water)) {
      data.series.push_back(std::move(one));
    }
  }
  auto made = frequency_chart(data, options.size, theme);
  if (!made) return pass_on(made);
  return std::move(made->frame);
}

}  // namespace sonar
