// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/live_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/geodesic.h"

namespace sonar {
namespace {

NmeaTarget target_of(const LiveSchool& school) {
  const SchoolPingRow& row = school.newest;
  NmeaTarget target;
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

int LiveTargets::free_number() const {
  constexpr int kMost = 99;
  for (int number = 1; number <= kMost; ++number) {
    const bool taken = std::any_of(told_.begin(), told_.end(),
                                   [&](const auto& entry) { return entry.second.target.number == number; });
    if (!taken) return number;
  }
  return 0;
}

std::vector<std::string> LiveTargets::sentences(std::span<const LiveSchool> seen) {
  constexpr int kLostAfter = 3;  // a school may be hidden for a ping
  std::vector<std::string> sentences;
  const auto tell = [&](const NmeaTarget& target) {
    sentences.push_back(tll_sentence(target));
    sentences.push_back(ttm_sentence(target));
  };
  for (auto& [name, told] : told_) ++told.missed;
  for (const LiveSchool& school : seen) {
    const auto [known, is_new] = told_.try_emplace(name_of(school));
    const int number = is_new ? free_number() : known->second.target.number;
    known->second = {target_of(school), 0};
    known->second.target.number = number;
    tell(known->second.target);
  }
  std::erase_if(told_, [&](auto& entry) {
    if (entry.second.missed < kLostAfter) return false;
    NmeaTarget lost = entry.second.target;
    lost.lost = true;
    tell(lost);
    return true;
  });
  return sentences;
}

std::vector<std::string> LiveTargets::end() {
  std::vector<std::string> all;
  while (!told_.empty()) {
    for (std::string& sentence : sentences({})) all.push_back(std::move(sentence));
  }
  return all;
}

}  // namespace sonar
