// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "school/track/track.h"

namespace sonar {

/// What was followed through the pings, as its judges see it; borrowed.
struct TrackEcho {
  std::span<const TrackedDetection> sightings;  ///< rising
  std::span<const DetectedPing> pings;          ///< all that were looked at, rising

  [[nodiscard]] const DetectedPing& ping(const TrackedDetection& sighting) const {
    return *ping_of(pings, sighting.ping_index);
  }
  /// The main detection of a sighting.
  [[nodiscard]] const Detection& detection(const TrackedDetection& sighting) const {
    return ping(sighting).detections[static_cast<std::size_t>(sighting.detections.front())];
  }
};

}  // namespace sonar
