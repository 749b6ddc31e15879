// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live_targets.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "geo/geodesic.h"

namespace sonar {
namespace {

NmeaTarget target_of(const LiveSchool& school) {
  const SchoolPingRow& row = school.newest;
  NmeaTarget target;
  target.number = static_cast<int>(row.school_id % 100);
  target.name = fmt::format("school {}", row.school_id);
  target.time = row.time_utc;
  target.latitude_deg = row.latitude;
  target.longitude_deg = row.longitude;
  target.bearing_deg = row.bearing_deg;
  // Charts want the way over ground, not the slant range.
  const bool placed = std::isfinite(row.latitude) && school.ship.has_position();
  target.distance_m = placed ? geodesic(school.ship.transducer, {row.latitude, row.longitude}).distance_m : kUnknown;
  target.speed_mps = school.school.speed_mps;
  target.course_deg = school.school.course_deg;
  return target;
}

}  // namespace

std::vector<std::string> LiveTargets::sentences(std::span<const LiveSchool> seen) {
  std::vector<std::string> sentences;
  const auto tell = [&](const NmeaTarget& target) {
    sentences.push_back(tll_sentence(target));
    sentences.push_back(ttm_sentence(target));
  };
  std::map<std::string, NmeaTarget> now;
  for (const LiveSchool& school : seen) {
    const NmeaTarget target = target_of(school);
    tell(target);
    now[name_of(school)] = target;
  }
  for (auto& [name, target] : told_) {
    if (now.contains(name)) continue;
    target.lost = true;
    tell(target);
  }
  told_ = std::move(now);
  return sentences;
}

}  // namespace sonar
