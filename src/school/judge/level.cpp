// SPDX-License-Identifier: Apache-2.0
#include "school/judge/level.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "base/median.h"
#include "school/judge/confirmation.h"

namespace sonar {

std::optional<Reason> judge_level(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                  const TrackParams& params) {
  std::vector<double> level_db;
  for (const TrackedDetection& seen : tracked) {
    const DetectedPing& ping = *ping_of(pings, seen.ping_index);
    level_db.push_back(ping.detections[static_cast<std::size_t>(seen.detections.front())].reference_db);
  }
  const double middle_db = middle_of(std::move(level_db));
  if (middle_db >= params.min_level_db) return std::nullopt;
  return Reason{"level", middle_db, params.min_level_db, "dB re 1 m-1"};
}

}  // namespace sonar
