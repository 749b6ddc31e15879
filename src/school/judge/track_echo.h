// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "school/track/track.h"

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

}  // namespace sonar
