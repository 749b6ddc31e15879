// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "school/judge/judges.h"
#include "school/runs.h"
#include "school/track/open_track.h"

namespace sonar {
namespace {

/// (first ping, channel, sample) of the first mask's first voxel.
std::array<std::int64_t, 3> order_key(const OpenTrack& track, std::span<const DetectedPing> pings,
                                      std::span<const int> channel_of_row) {
  const auto at = ping_of(pings, track.pings.front().ping_index);
  std::array<std::int64_t, 3> key{track.pings.front().ping_index, INT64_MAX, INT64_MAX};
  for (const int d : track.pings.front().detections) {
    for (const Run& run : at->detections[static_cast<std::size_t>(d)].mask.runs) {
      const auto row = static_cast<std::size_t>(run.row);
      const std::int64_t channel = row < channel_of_row.size() ? channel_of_row[row] : run.row;
      if (std::pair(channel, std::int64_t{run.first_sample}) < std::pair(key[1], key[2])) {
        key[1] = channel;
        key[2] = run.first_sample;
      }
    }
  }
  return key;
}

std::optional<Reason> refused(const TrackEcho& track, const TrackParams& params) {
  for (const TrackJudge& judge : kTrackJudges) {
    if (auto reason = ask(judge, params, track)) return reason;
  }
  return std::nullopt;
}

}  // namespace

Tracks number_tracks(std::span<const OpenTrack> closed, std::span<const RawEvent> events,
                     std::span<const DetectedPing> pings, std::span<const int> channel, const TrackParams& params) {
  Tracks tracks;
  std::vector<std::pair<std::array<std::int64_t, 3>, const OpenTrack*>> order;
  for (const OpenTrack& track : closed) {
    if (auto reason = refused({track.pings, pings}, params)) {
      tracks.refused.push_back({*reason, track.pings});
      continue;
    }
    order.emplace_back(order_key(track, pings, channel), &track);
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  int numbers = 0;
  for (const OpenTrack& track : closed) numbers = std::max(numbers, track.number + 1);
  std::vector<std::int64_t> id_of(static_cast<std::size_t>(numbers), 0);
  for (const auto& [key, track] : order) {
    const auto id = static_cast<std::int64_t>(tracks.schools.size()) + 1;
    id_of[static_cast<std::size_t>(track->number)] = id;
    tracks.schools.push_back({id, track->pings});
  }
  for (const RawEvent& raw : events) {
    const std::int64_t id = id_of[static_cast<std::size_t>(raw.track)];
    const std::int64_t other = raw.other >= 0 ? id_of[static_cast<std::size_t>(raw.other)] : 0;
    if (id == 0 || (raw.other >= 0 && other == 0)) continue;
    tracks.events.push_back({raw.kind, raw.ping_index, id, other});
  }
  std::sort(tracks.events.begin(), tracks.events.end(), [](const TrackEvent& a, const TrackEvent& b) {
    return std::tuple(a.ping_index, static_cast<int>(a.kind), a.school_id, a.other_id) <
           std::tuple(b.ping_index, static_cast<int>(b.kind), b.school_id, b.other_id);
  });
  return tracks;
}

std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings, std::int64_t ping_index) {
  return std::ranges::lower_bound(pings, ping_index, {}, &DetectedPing::ping_index);
}

PingMask mask_of(const TrackedDetection& tracked, const DetectedPing& ping) {
  if (!tracked.part.empty()) return tracked.part;
  PingMask mask;
  for (const int d : tracked.detections) {
    const PingMask& piece = ping.detections[static_cast<std::size_t>(d)].mask;
    mask = mask.empty() ? piece : unite(mask, piece);
  }
  return mask;
}

}  // namespace sonar
