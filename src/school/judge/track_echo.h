// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "school/judge/reason.h"
#include "school/track.h"

namespace sonar {

/// What was followed through the pings, as its judges see it; borrowed.
struct TrackEcho {
  std::span<const TrackedDetection> sights;  ///< rising
  std::span<const DetectedPing> pings;       ///< all that were looked at, rising

  [[nodiscard]] const DetectedPing& ping(const TrackedDetection& sight) const {
    return *ping_of(pings, sight.ping_index);
  }
  /// The main detection of a sight.
  [[nodiscard]] const Detection& detection(const TrackedDetection& sight) const {
    return ping(sight).detections[static_cast<std::size_t>(sight.detections.front())];
  }
};

/// A judge of tracks: why one is no school, if it thinks so.
struct TrackJudge {
  std::string_view name;
  std::optional<Reason> (*judge)(const TrackEcho& track, const TrackParams& params);
};

}  // namespace sonar
