// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score_pairs.h"

#include <tuple>
#include <utility>

#include "geo/geodesic.h"

namespace sonar {
namespace {

bool is_unclipped(const SchoolPingRow* row) { return row == nullptr || row->touches_edge == 0; }

PingPair pair_ping(const Indexed& found, const Indexed& truth, const ScoreSide& truth_side, const PingKey& key) {
  PingPair pair;
  const auto& [observation, school_id, ping_index] = key;
  pair.ping_index = ping_index;
  pair.truth = &truth.masks.at(key);
  const auto row = truth.rows.find(key);
  pair.truth_row = row == truth.rows.end() ? nullptr : row->second;
  pair.unclipped = is_unclipped(pair.truth_row);
  const TimeNs time = truth_side.observations[observation].pings[static_cast<std::size_t>(ping_index)].time;
  const auto there = ping_at(found, time);
  if (!there) return pair;
  pair.found_observation = there->first;
  pair.found_ping = there->second;
  const auto schools = found.in_ping.find(*there);
  if (schools == found.in_ping.end()) return pair;
  for (const std::int64_t id : schools->second) {
    const PingMask& mask = found.masks.at({there->first, id, there->second});
    const std::size_t shared = overlap(mask, *pair.truth);
    if (shared <= pair.overlap || dice(mask, *pair.truth) < kPairDice) continue;
    pair.overlap = shared;
    pair.partner = SchoolKey{there->first, id};
  }
  return pair;
}

}  // namespace

std::map<SchoolKey, std::vector<PingPair>> pair_pings(const Indexed& found, const Indexed& truth,
                                                      const ScoreSide& truth_side) {
  std::map<SchoolKey, std::vector<PingPair>> pairs;
  for (const auto& [key, mask] : truth.masks) {
    pairs[{std::get<0>(key), std::get<1>(key)}].push_back(pair_ping(found, truth, truth_side, key));
  }
  return pairs;
}

std::optional<SchoolKey> track_partner(const std::vector<PingPair>& pairs) {
  std::map<SchoolKey, std::pair<std::size_t, std::size_t>> votes;
  for (const PingPair& pair : pairs) {
    if (!pair.partner) continue;
    auto& [pings, voxels] = votes[*pair.partner];
    ++pings;
    voxels += pair.overlap;
  }
  std::optional<SchoolKey> best;
  for (const auto& [key, vote] : votes) {
    if (!best || vote > votes[*best]) best = key;
  }
  return best;
}

double distance_m(const SchoolPingRow& a, const SchoolPingRow& b) {
  const bool known = std::isfinite(a.latitude) && std::isfinite(b.latitude);
  const double level = known ? geodesic({a.latitude, a.longitude}, {b.latitude, b.longitude}).distance_m : kUnknown;
  return std::hypot(level, a.depth_m - b.depth_m);
}

}  // namespace sonar
