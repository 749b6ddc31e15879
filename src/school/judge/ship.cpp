// SPDX-License-Identifier: Apache-2.0
#include "school/judge/ship.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/school.h"
#include "school/motion.h"

namespace sonar {
namespace {

constexpr std::int32_t kCutAside = kEdgeFore | kEdgeAft;

struct Sight {
  double time_s = 0.0;
  Point<Sonar> seen;  ///< from the ship
  Point<Enu> ship;
  Point<Enu> there;  ///< the same over ground
};

/// Slope of a coordinate over time, by least squares.
template <class Coordinate>
double rate(const std::vector<Sight>& sights, const Coordinate& coordinate) {
  double mean_t = 0.0;
  double mean_x = 0.0;
  for (const Sight& sight : sights) {
    mean_t += sight.time_s / static_cast<double>(sights.size());
    mean_x += coordinate(sight) / static_cast<double>(sights.size());
  }
  double tx = 0.0;
  double tt = 0.0;
  for (const Sight& sight : sights) {
    tx += (sight.time_s - mean_t) * (coordinate(sight) - mean_x);
    tt += (sight.time_s - mean_t) * (sight.time_s - mean_t);
  }
  return tt > 0.0 ? tx / tt : 0.0;
}

}  // namespace

std::optional<Reason> judge_ship(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                 const TrackParams& params) {
  if (params.ship_drift_share <= 0.0 || tracked.size() < 3) return std::nullopt;
  std::vector<Sight> sights;
  const auto index_of = [](const DetectedPing& ping) { return ping.ping_index; };
  for (const TrackedDetection& there : tracked) {
    const auto ping = std::ranges::lower_bound(pings, there.ping_index, {}, index_of);
    const Detection& detection = ping->detections[static_cast<std::size_t>(there.detections.front())];
    if ((detection.edge_flags & kCutAside) != 0) return std::nullopt;
    const PingFrame frame(ping->placement, pings.front().placement.transducer);
    const auto since = static_cast<double>(ping->time - pings.front().time) / static_cast<double>(kSecondNs);
    sights.push_back({since, detection.centre, frame.to_world({}), frame.to_world(detection.centre)});
  }
  const Point<Enu> way = sights.back().ship - sights.front().ship;
  const double way_m = std::hypot(way.x, way.y);
  const Point<Enu> its_way = sights.back().there - sights.front().there;
  const double took_s = sights.back().time_s - sights.front().time_s;
  if (way_m < TrackParams::ship_least_m || way_m < TrackParams::ship_least_mps * took_s) return std::nullopt;
  // a ship that circles a school keeps it abeam
  if (std::hypot(its_way.x, its_way.y) < (1.0 - params.ship_drift_share) * way_m) return std::nullopt;
  const double drift_mps = std::hypot(rate(sights, [](const Sight& s) { return s.seen.x; }),
                                      rate(sights, [](const Sight& s) { return s.seen.y; }));
  const double share = drift_mps * took_s / way_m;
  if (share > params.ship_drift_share) return std::nullopt;
  return Reason{"ship", share, params.ship_drift_share, "share of the ship's way"};
}

}  // namespace sonar
