// SPDX-License-Identifier: Apache-2.0
#include "school/track/inseparable.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "school/detect/detect_params.h"
#include "school/runs.h"

namespace sonar {
namespace {

constexpr std::size_t kLeastSightings = 3;  ///< of both, in which they touch
constexpr std::size_t kSightings = 4;       ///< in three of so many sightings of both they touch

/// Whether two masks of a ping lie in the same beam or in beams side by side, no farther apart along range than detection looks round.
bool touch(const PingMask& a, const PingMask& b, const Sector& sector) {
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  const std::vector<int> first = index_rows(b.runs, shape.rows());
  const auto meets = [&](const Run& run, int row) {
    const auto r = static_cast<std::size_t>(row);
    return std::any_of(b.runs.begin() + first[r], b.runs.begin() + first[r + 1], [&](const Run& other) {
      return other.first_sample < run.end() + SearchReach::samples &&
             run.first_sample < other.end() + SearchReach::samples;
    });
  };
  return std::ranges::any_of(a.runs, [&](const Run& run) {
    const NeighbourRows beside = neighbour_rows(run.row, shape, Connectivity::faces);
    return meets(run, run.row) ||
           std::any_of(beside.row, beside.row + beside.count, [&](int row) { return meets(run, row); });
  });
}

/// Visits the sightings that two tracks have of one ping.
template <class Visit>
void each_pair(const OpenTrack& a, const OpenTrack& b, const Visit& visit) {
  auto at = b.pings.begin();
  for (const TrackedDetection& seen : a.pings) {
    while (at != b.pings.end() && at->ping_index < seen.ping_index) ++at;
    if (at == b.pings.end()) return;
    if (at->ping_index == seen.ping_index) visit(seen, *at);
  }
}

bool inseparable(const OpenTrack& a, const OpenTrack& b, std::span<const DetectedPing> pings, const Sector& sector) {
  std::size_t both = 0;
  each_pair(a, b, [&](const auto&, const auto&) { ++both; });
  if (both < kLeastSightings) return false;
  std::size_t touching = 0;
  each_pair(a, b, [&](const TrackedDetection& one, const TrackedDetection& other) {
    const DetectedPing& ping = *ping_of(pings, one.ping_index);
    if (touch(mask_of(one, ping), mask_of(other, ping), sector)) ++touching;
  });
  return touching >= kLeastSightings && kSightings * touching >= (kSightings - 1) * both;
}

/// One sighting of both: the larger detection stays the main one.
TrackedDetection together(const TrackedDetection& a, const TrackedDetection& b, const DetectedPing& ping) {
  const auto volume = [&](const TrackedDetection& seen) {
    return ping.detections[static_cast<std::size_t>(seen.detections.front())].volume_m3;
  };
  const TrackedDetection& main = volume(a) >= volume(b) ? a : b;
  const TrackedDetection& other = &main == &a ? b : a;
  TrackedDetection sighting = main;
  for (const int d : other.detections) {
    if (std::ranges::find(sighting.detections, d) == sighting.detections.end()) sighting.detections.push_back(d);
  }
  std::sort(sighting.detections.begin() + 1, sighting.detections.end());
  if (a.part.empty() && b.part.empty()) return sighting;
  sighting.part = {};
  PingMask mask = unite(mask_of(a, ping), mask_of(b, ping));
  if (mask.voxels() != mask_of(sighting, ping).voxels()) sighting.part = std::move(mask);
  return sighting;
}

void join(OpenTrack& into, const OpenTrack& from, std::span<const DetectedPing> pings) {
  std::vector<TrackedDetection> sightings;
  auto a = into.pings.begin();
  auto b = from.pings.begin();
  while (a != into.pings.end() || b != from.pings.end()) {
    if (b == from.pings.end() || (a != into.pings.end() && a->ping_index < b->ping_index)) {
      sightings.push_back(std::move(*a++));
    } else if (a == into.pings.end() || b->ping_index < a->ping_index) {
      sightings.push_back(*b++);
    } else {
      sightings.push_back(together(*a, *b, *ping_of(pings, a->ping_index)));
      ++a;
      ++b;
    }
  }
  into.pings = std::move(sightings);
}

void rename(std::vector<RawEvent>& events, int from, int into) {
  for (RawEvent& event : events) {
    if (event.track == from) event.track = into;
    if (event.other == from) event.other = into;
  }
}

/// Of a school that several tracks made: its first birth, its last death, and nothing among its own parts.
void tidy(std::vector<RawEvent>& events, const OpenTrack& school) {
  const std::int64_t first = school.pings.front().ping_index;
  const std::int64_t last = school.pings.back().ping_index;
  bool born = false;
  bool dead = false;
  std::erase_if(events, [&](const RawEvent& event) {
    if (event.track != school.number) return false;
    if (event.kind == TrackEventKind::birth) return event.ping_index != first || std::exchange(born, true);
    if (event.kind == TrackEventKind::death) return event.ping_index != last || std::exchange(dead, true);
    return event.other == school.number;
  });
}

}  // namespace

void join_inseparable(std::vector<OpenTrack>& closed, std::vector<RawEvent>& events,
                      std::span<const DetectedPing> pings, const Sector& sector) {
  std::ranges::sort(closed, {}, &OpenTrack::number);
  for (std::size_t i = 0; i < closed.size(); ++i) {
    bool joined = false;
    for (std::size_t k = i + 1; k < closed.size(); ++k) {
      if (!inseparable(closed[i], closed[k], pings, sector)) continue;
      join(closed[i], closed[k], pings);
      rename(events, closed[k].number, closed[i].number);
      closed.erase(closed.begin() + static_cast<std::ptrdiff_t>(k));
      joined = true;
      k = i;  // what did not touch either part alone so often may touch both
    }
    if (joined) tidy(events, closed[i]);
  }
}

}  // namespace sonar
