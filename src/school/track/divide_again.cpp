// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "school/track/divide.h"
#include "school/track/open_track.h"

namespace sonar {
namespace {

/// The entry of a track in a ping, where it shared a detection there.
TrackedDetection* shared_in(OpenTrack& track, std::int64_t ping_index) {
  const auto at = std::lower_bound(track.pings.begin(), track.pings.end(), ping_index,
                                   [](const TrackedDetection& seen, std::int64_t i) { return seen.ping_index < i; });
  if (at == track.pings.end() || at->ping_index != ping_index || at->part.empty()) return nullptr;
  return &*at;
}

struct Sharer {
  TrackedDetection* seen = nullptr;
  ExpectedBody body;
};

/// Gives each sharer its part, unless someone else has a part of the detection or one would get nothing.
void share_out(std::vector<Sharer>& sharers, const DetectedPing& ping, const PingFrame& frame, const Sector& sector,
               double least_m) {
  if (sharers.size() < 2) return;
  const auto detection = static_cast<std::size_t>(sharers.front().seen->detections.front());
  const PingMask& whole = ping.detections[detection].mask;
  std::size_t held = 0;
  std::vector<ExpectedBody> bodies;
  for (const Sharer& sharer : sharers) {
    held += sharer.seen->part.voxels();
    bodies.push_back(sharer.body);
  }
  if (held != whole.voxels()) return;
  std::vector<PingMask> parts = divide(whole, sector, frame, bodies, least_m);
  if (std::any_of(parts.begin(), parts.end(), [](const PingMask& part) { return part.empty(); })) return;
  for (std::size_t i = 0; i < parts.size(); ++i) sharers[i].seen->part = std::move(parts[i]);
}

}  // namespace

void divide_again(std::span<OpenTrack> open, std::span<const std::size_t> parted, std::span<const Point<Enu>> now,
                  std::size_t p, std::span<const DetectedPing> pings, std::span<const PingFrame> frames,
                  const Sector& sector, double least_m) {
  std::size_t first = p;
  for (const std::size_t t : parted) first = std::min(first, open[t].alone_ping);
  for (std::size_t q = first + 1; q < p; ++q) {
    for (std::size_t d = 0; d < pings[q].detections.size(); ++d) {
      std::vector<Sharer> sharers;
      for (std::size_t i = 0; i < parted.size(); ++i) {
        OpenTrack& track = open[parted[i]];
        TrackedDetection* seen = shared_in(track, pings[q].ping_index);
        if (q <= track.alone_ping || seen == nullptr || seen->detections.front() != static_cast<int>(d)) continue;
        const auto gone = static_cast<double>(pings[q].time - pings[track.alone_ping].time);
        const auto whole = static_cast<double>(pings[p].time - pings[track.alone_ping].time);
        const Point<Enu> place = track.alone_at + (now[i] - track.alone_at) * (gone / whole);
        sharers.push_back({seen, {place, track.shape}});
      }
      share_out(sharers, pings[q], frames[q], sector, least_m);
    }
  }
}

}  // namespace sonar
