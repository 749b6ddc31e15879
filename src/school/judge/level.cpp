// SPDX-License-Identifier: Apache-2.0
#include "school/judge/level.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "base/middle.h"

namespace sonar {

std::optional<Reason> judge_level(const TrackEcho& track, const LevelParams& params) {
  std::vector<double> level_db;
  for (const TrackedDetection& sighting : track.sightings) level_db.push_back(track.detection(sighting).reference_db);
  const double middle_db = middle_of(std::move(level_db));
  if (middle_db >= params.min_level_db) return std::nullopt;
  return Reason{"level", middle_db, params.min_level_db, "dB re 1 m-1"};
}

}  // namespace sonar
