// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "school/mask_shape.h"
#include "school/track/motion.h"
#include "school/track/track.h"

namespace sonar {

/// A school being followed.
struct OpenTrack {
  int number = 0;  ///< order of birth
  Motion motion;
  std::vector<TrackedDetection> pings;
  std::size_t last_ping = 0;  ///< position in the list of pings
  double volume_m3 = 0.0;
  double reference_db = 0.0;
  int pieces_streak = 0;  ///< pings in a row with more than one detection
  bool merged = false;
  int own_pings = 0;    ///< in which it shared its detection with no other school
  Covariance3 shape{};  ///< east, north, up, m^2; when last alone
  /// While it shares a detection: its motion when last alone, carried on. Which voxels of the joint echo are whose is a
  /// guess by where the schools stand, so their shares cannot tell how they swam through each other.
  std::optional<Motion> apart;
  Point<Enu> alone_at;         ///< where it was when last alone
  std::size_t alone_ping = 0;  ///< position of that ping in the list of pings

  [[nodiscard]] bool shares() const { return !pings.back().part.empty(); }
};

/// An event between tracks by their order of birth.
struct RawEvent {
  TrackEventKind kind;
  std::int64_t ping_index;
  int track;
  int other;  ///< -1 = none
};

/// Shares out anew the detections in which schools had met that are apart again in ping `p`: each swam straight from
/// where it was when last alone to where it is now, which no ping between could tell.
/// parted    tracks of `open` that shared until now; where they stood when last alone is still in them
/// now       [parted] their places in ping `p`
/// frames    [ping] of the list of pings
/// least_m   as divide()
void divide_again(std::span<OpenTrack> open, std::span<const std::size_t> parted, std::span<const Point<Enu>> now,
                  std::size_t p, std::span<const DetectedPing> pings, std::span<const PingFrame> frames,
                  const Sector& sector, double least_m);

/// Drops the tracks that were not seen often enough or that stay with the ship, numbers the others by (first ping,
/// channel, sample) and renames the events.
/// closed  all tracks
/// pings, channel, params  as track()
[[nodiscard]] Tracks number_tracks(std::span<const OpenTrack> closed, std::span<const RawEvent> events,
                                   std::span<const DetectedPing> pings, std::span<const int> channel,
                                   const TrackParams& params);

}  // namespace sonar
