// SPDX-License-Identifier: Apache-2.0
#include "school/judge/surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/middle.h"
#include "model/school.h"

namespace sonar {
namespace {

/// To which bubble clouds reach in strong winds (Thorpe 1992, Bubble clouds and the dynamics of the upper ocean).
constexpr double kBubbleDepth_m = 20.0;
/// Bubbles that deep are fainter at the frequencies of these sonars; of what is louder fish are the likelier cause. The array
/// simulator's strongest clouds, a hull's, reach -55 dB.
constexpr double kBubbleLevel_db = -50.0;
/// Half the height of an ellipsoid in standard deviations of its voxels: root of 5.
constexpr double kHalfHeight = 2.236;

}  // namespace

std::optional<Reason> judge_surface(const TrackEcho& track) {
  std::vector<double> reach_m;
  std::size_t attached = 0;
  double level_db = -1000.0;
  for (const TrackedDetection& sighting : track.sightings) {
    const DetectedPing& ping = track.ping(sighting);
    const Detection& echo = track.detection(sighting);
    if ((echo.edge_flags & (kEdgeTopFan | kEdgeSurface)) != 0) ++attached;
    level_db = std::max(level_db, echo.reference_db);
    const double centre_m = ping.placement.transducer_depth_m + levelled(echo.centre, ping.placement).z;
    reach_m.push_back(centre_m + kHalfHeight * std::sqrt(echo.covariance[5]));
  }
  if (2 * attached < track.sightings.size() || level_db > kBubbleLevel_db) return std::nullopt;
  const double middle_m = middle_of(std::move(reach_m));
  if (!(middle_m <= kBubbleDepth_m)) return std::nullopt;
  return Reason{"surface", middle_m, kBubbleDepth_m, "m deep at most"};
}

}  // namespace sonar
