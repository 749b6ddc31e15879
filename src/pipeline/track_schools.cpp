// SPDX-License-Identifier: Apache-2.0
#include "pipeline/track_schools.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "school/detect_params.h"
#include "school/judge/size.h"
#include "school/second_look.h"
#include "school/steady_masks.h"

namespace sonar {
namespace {

struct Wanted {
  std::size_t school = 0;
  ExpectedSight expected;
};

std::map<std::size_t, std::vector<Wanted>> wanted_by_ping(const Tracks& tracks, const std::vector<DetectedPing>& pings,
                                                          const Sector& sector) {
  std::map<std::size_t, std::vector<Wanted>> wanted;
  for (std::size_t s = 0; s < tracks.schools.size(); ++s) {
    for (ExpectedSight& expected : expected_sights(tracks.schools[s], pings, sector)) {
      wanted[expected.ping].push_back({s, std::move(expected)});
    }
  }
  return wanted;
}

PingMask masks_of_schools(const Tracks& tracks, const DetectedPing& ping) {
  PingMask taken;
  for (const SchoolTrack& school : tracks.schools) {
    const auto at = std::ranges::lower_bound(school.pings, ping.ping_index, {}, &TrackedDetection::ping_index);
    if (at != school.pings.end() && at->ping_index == ping.ping_index) taken = unite(taken, mask_of(*at, ping));
  }
  return taken;
}

/// What one ping shows of the schools that are expected in it; the first takes what several reach for.
std::vector<std::optional<Detection>> look_in(Engine& engine, const DetectedPing& at, PingMask taken,
                                              const std::vector<Wanted>& wanted) {
  std::vector<std::optional<Detection>> found(wanted.size());
  const auto ping = engine.kept_or_staged(at.ping_index);
  if (!ping) return found;  // measuring would tell why
  const PingEcho echo = engine.echo(**ping, at.water);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    found[i] = detect_expected(echo, wanted[i].expected, taken, engine.recipe().detect);
    if (found[i]) taken = unite(taken, found[i]->mask);
  }
  if (std::ranges::any_of(found, [](const auto& one) { return one.has_value(); })) engine.keep(*ping);
  return found;
}

void second_look(Engine& engine, Tracks& tracks, std::vector<DetectedPing>& pings, Work& work) {
  const auto by_ping = wanted_by_ping(tracks, pings, engine.sector());
  const std::vector<std::pair<std::size_t, std::vector<Wanted>>> wanted(by_ping.begin(), by_ping.end());
  std::vector<std::vector<std::optional<Detection>>> found(wanted.size());
  work.for_each(std::ssize(wanted), [&](std::int64_t i) {
    const auto& [ping, schools] = wanted[static_cast<std::size_t>(i)];
    found[static_cast<std::size_t>(i)] =
        look_in(engine, pings[ping], masks_of_schools(tracks, pings[ping]), schools);
  });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    DetectedPing& ping = pings[wanted[i].first];
    for (std::size_t k = 0; k < found[i].size(); ++k) {
      if (!found[i][k]) continue;
      std::vector<TrackedDetection>& sights = tracks.schools[wanted[i].second[k].school].pings;
      const auto at = std::ranges::lower_bound(sights, ping.ping_index, {}, &TrackedDetection::ping_index);
      sights.insert(at, {ping.ping_index, {static_cast<int>(ping.detections.size())}, {}});
      ping.detections.push_back(std::move(*found[i][k]));
    }
  }
}

}  // namespace

Tracks track_schools(Engine& engine, std::vector<DetectedPing>& detected, Work& work) {
  TrackParams params = engine.recipe().track;
  params.evidence = evidence_wanted(engine.recipe().detect);
  Tracks tracks = track(detected, engine.sector(), engine.grid().channel, params);
  second_look(engine, tracks, detected, work);
  std::erase_if(tracks.schools, [&](SchoolTrack& school) {
    steady_masks(school, detected, engine.sector());
    const auto reason = judge_size(school.pings, detected, engine.sector(), engine.recipe().detect);
    if (reason) tracks.refused.push_back({*reason, std::move(school.pings)});
    return reason.has_value();
  });
  return tracks;
}

}  // namespace sonar
