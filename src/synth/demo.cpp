// SPDX-License-Identifier: Apache-2.0
#include "synth/demo.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/units.h"
#include "synth/layout.h"
#include "synth/placement.h"

namespace sonar::synth {
namespace {

constexpr double kNear_m = 100.0;
constexpr double kFar_m = 300.0;
constexpr double kBelowTransducer_m = 55.0;
constexpr double kEmptyLegBeyond_m = 650.0;

double level_distance(double range_m) { return std::sqrt(range_m * range_m - kBelowTransducer_m * kBelowTransducer_m); }

Body school(const SurveyParams& params, int id, const Point<Enu>& centre, const Point<Enu>& velocity, double length_m,
            double sv_db) {
  Body body;
  body.school_id = id;
  const SizeAndLevel size{length_m, 0.6 * length_m, 12.0, 20.0, sv_db};
  body.shape =
      ragged_shape(params, size, static_cast<std::uint64_t>(params.seed) * 1000 + static_cast<std::uint64_t>(id));
  body.centre_m = centre;
  body.velocity_mps = velocity;
  return body;
}

int channel_towards(const Scene& scene, double elevation_deg) {
  std::size_t best = 0;
  const auto off = [&](std::size_t i) {
    return std::abs(scene.beams[i].elevation_deg - elevation_deg) + std::abs(scene.beams[i].azimuth_deg);
  };
  for (std::size_t i = 1; i < scene.beams.size(); ++i) {
    if (off(i) < off(best)) best = i;
  }
  return static_cast<int>(best);
}

/// Corrupted packets and, a ping later, interference through a body when it is abeam of a ship that sails north along x = 0.
void disturb(Scene& scene, const Body& body) {
  const double abeam_s = (body.centre_m.y - scene.ship.start_m.y) / (scene.ship.speed_mps - body.velocity_mps.y);
  const int ping = static_cast<int>(std::lround(abeam_s / scene.ping_interval_s));
  const Point<Enu> at = body.centre_at(scene.seconds_of(ping));
  const double down_m = -at.z - scene.ship.transducer_depth_m;
  const double range_m = std::hypot(at.x, down_m);
  const double elevation_deg = -deg_from_rad(std::asin(down_m / range_m));
  const int sample = static_cast<int>(make_layout(scene.beams).range.sample_at(range_m));
  scene.corrupted_packets.push_back({ping, channel_towards(scene, elevation_deg), sample - 200, 400, -112.0});
  scene.interference.push_back({ping + 1, sample - 2, 4, -115.0, -1});
}

}  // namespace

std::vector<Scene> demo_scenes(const SurveyParams& params, const std::vector<Beam>& beams) {
  Scene north = scene_base(params, beams, 0);
  Scene empty = scene_base(params, beams, 1);
  Scene south = scene_base(params, beams, 2);
  const double leg_m = north.ship.speed_mps * north.seconds_of(north.pings);
  north.ship.course_deg = 0.0;
  empty.pings = std::max(1, params.pings / 3);
  empty.ship.course_deg = 270.0;
  empty.ship.start_m = {0.0, leg_m + kEmptyLegBeyond_m, 0.0};
  follow_on(north, params.gap_s, empty);
  south.ship.course_deg = 180.0;
  south.ship.start_m = {-(level_distance(kNear_m) + level_distance(kFar_m)), leg_m, 0.0};
  follow_on(empty, params.gap_s, south);

  // Without schools asked for there are none; the three that tell a story come first.
  const double depth_m = north.ship.transducer_depth_m + kBelowTransducer_m;
  SurveyParams others = params;
  if (params.schools >= 3) {
    north.bodies = {
        school(params, 1, {-level_distance(kNear_m), 0.35 * leg_m, -depth_m}, {0.0, 0.05, 0.0}, 30.0, -38.0),
        school(params, 2, {-180.0, 0.75 * leg_m, -depth_m - 10.0}, {0.1, -1.2, 0.0}, 40.0, -40.0),
        school(params, 3, {-220.0, 0.15 * leg_m, -depth_m - 15.0}, {0.02, 0.1, 0.0}, 50.0, -39.0)};
    disturb(north, north.bodies[2]);
    others.schools -= 3;
  }
  if (others.schools > 0) place_schools(others, north);

  const double later_s = static_cast<double>(south.first_ping - north.first_ping) / static_cast<double>(kSecondNs);
  for (Body body : north.bodies) {
    body.centre_m = body.centre_at(later_s);
    south.bodies.push_back(std::move(body));
  }
  return {std::move(north), std::move(empty), std::move(south)};
}

}  // namespace sonar::synth
