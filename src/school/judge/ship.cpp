// SPDX-License-Identifier: Apache-2.0
#include "school/judge/ship.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/school.h"
#include "school/track/motion.h"

namespace sonar {
namespace {

constexpr double kLeast_mps = 0.5;     ///< of a ship that does not drift with the water
constexpr double kLeast_m = 20.0;      ///< ... and went so far
constexpr double kLeastCut_m = 200.0;  ///< ... or, beside what the sector cuts, farther than schools are long
constexpr double kFish_mps = 1.0;      ///< standard deviation of a school's velocity, per axis
constexpr double kFishChance = 0.01;   ///< of schools go with the ship by chance, and are refused
constexpr std::int32_t kCutAside = kEdgeFore | kEdgeAft;

struct Sighting {
  double time_s = 0.0;
  Point<Sonar> seen;  ///< from the ship
  Point<Enu> ship;
  Point<Enu> there;  ///< the same over ground
};

/// Slope of a coordinate over time, by least squares.
template <class Coordinate>
double rate(const std::vector<Sighting>& sightings, const Coordinate& coordinate) {
  double mean_t = 0.0;
  double mean_x = 0.0;
  for (const Sighting& sighting : sightings) {
    mean_t += sighting.time_s / static_cast<double>(sightings.size());
    mean_x += coordinate(sighting) / static_cast<double>(sightings.size());
  }
  double tx = 0.0;
  double tt = 0.0;
  for (const Sighting& sighting : sightings) {
    tx += (sighting.time_s - mean_t) * (coordinate(sighting) - mean_x);
    tt += (sighting.time_s - mean_t) * (sighting.time_s - mean_t);
  }
  return tt > 0.0 ? tx / tt : 0.0;
}

/// Length of a way along a few straight stretches: a ship that turns has made all of it, and what jitters to and fro none.
template <class Place>
double way_m(const std::vector<Sighting>& sightings, const Place& place) {
  constexpr std::size_t kStretches = 4;
  const std::size_t last = sightings.size() - 1;
  double way = 0.0;
  for (std::size_t i = 0; i < kStretches; ++i) {
    const Point<Enu> step = place(sightings[last * (i + 1) / kStretches]) - place(sightings[last * i / kStretches]);
    way += std::hypot(step.x, step.y);
  }
  return way;
}

/// Share of schools whose velocity lies so near the ship's.
double chance(double ship_mps, double drift_mps) {
  const double variance = kFish_mps * kFish_mps;
  return drift_mps * drift_mps / (2.0 * variance) * std::exp(-ship_mps * ship_mps / (2.0 * variance));
}

}  // namespace

std::optional<Reason> judge_ship(const TrackEcho& track, const ShipParams& params) {
  if (params.drift_share <= 0.0 || track.sightings.size() < 3) return std::nullopt;
  std::vector<Sighting> sightings;
  bool cut = false;
  const DetectedPing& first = track.pings.front();
  for (const TrackedDetection& sighting : track.sightings) {
    const DetectedPing& ping = track.ping(sighting);
    const Detection& detection = track.detection(sighting);
    cut = cut || (detection.edge_flags & kCutAside) != 0;
    const PingFrame frame(ping.placement, first.placement.transducer);
    const auto since = static_cast<double>(ping.time - first.time) / static_cast<double>(kSecondNs);
    sightings.push_back({since, detection.centre, frame.to_world({}), frame.to_world(detection.centre)});
  }
  const double took_s = sightings.back().time_s - sightings.front().time_s;
  const double ship_m = way_m(sightings, [](const Sighting& s) { return s.ship; });
  if (ship_m < (cut ? kLeastCut_m : kLeast_m)) return std::nullopt;
  if (ship_m < kLeast_mps * took_s) return std::nullopt;
  // a ship that circles a school keeps it abeam
  if (way_m(sightings, [](const Sighting& s) { return s.there; }) < (1.0 - params.drift_share) * ship_m) {
    return std::nullopt;
  }
  const double drift_mps = std::hypot(rate(sightings, [](const Sighting& s) { return s.seen.x; }),
                                      rate(sightings, [](const Sighting& s) { return s.seen.y; }));
  const double share = drift_mps * took_s / ship_m;
  if (share > params.drift_share || chance(ship_m / took_s, drift_mps) > kFishChance) {
    return std::nullopt;
  }
  return Reason{"ship", share, params.drift_share, "share of the ship's way"};
}

}  // namespace sonar
