// SPDX-License-Identifier: Apache-2.0
#include "synth/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "base/units.h"
#include "geo/geodesic.h"
#include "synth/layout.h"
#include "synth/placement.h"
#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr Geographic kArea{60.5, 3.5};
constexpr double kBetweenObservations_m = 15'000.0;

void easy(SurveyParams& p) {
  p.observations = 1;
  p.schools = 4;
  p.length_min_m = 30.0;
  p.range_max_m = 250.0;
  p.sv_min_db = -42.0;
  p.own_speed_max_mps = 0.5;
  p.raggedness = 0.0;
  p.nuclei = 0;
  p.vacuoles = 0;
  p.motion_deg = 0.0;
  p.noise.background_power_db = -178.0;
  p.noise.background_spread_db = 1.0;
}

void faults(Noise& n, double much) {
  n.corrupted_packets = 0.3 * much;
  n.interference = 0.15 * much;
  n.impulse_noise = 150.0 * much;
  n.dropouts = 0.05 * much;
}

void hard(SurveyParams& p) {
  p.schools = 8;
  p.speed_knots = 10.0;
  p.pings = 150;
  p.sv_min_db = -55.0;
  p.above_background_db = 6.0;
  p.raggedness = 0.3;
  p.vacuoles = 3;
  p.crossings = 1;
  p.splits = 1;
  p.motion_deg = 2.5;
  p.new_file_per_observation = false;
  p.water.surface_db = -40.0;
  p.water.seabed_depth_m = 180.0;
  p.water.seabed_slope_east = 0.02;
  p.water.seabed_slope_north = -0.01;
  p.water.reverberation_sv_db = -80.0;
  p.noise.background_power_db = -165.0;
  p.noise.background_spread_db = 3.0;
  p.noise.side_lobe_db = -25.0;
  faults(p.noise, 3.0);
}

void demo(SurveyParams& p) {
  p.schools = 12;
  p.pings = 160;
  p.own_speed_min_mps = 0.05;
  p.own_speed_max_mps = 0.2;
  p.sv_min_db = -46.0;
  p.noise.background_power_db = -172.0;
  faults(p.noise, 0.3);
}

Result<void> check(const SurveyParams& p) {
  if (auto ok = validate(p); !ok) return ok;
  struct Span {
    std::string_view least_name, most_name;
    double least, most;
  };
  const std::array<Span, 6> spans{
      {{"length_min_m", "length_max_m", p.length_min_m, p.length_max_m},
       {"height_min_m", "height_max_m", p.height_min_m, p.height_max_m},
       {"range_min_m", "range_max_m", p.range_min_m, p.range_max_m},
       {"above_seabed_min_m", "above_seabed_max_m", p.above_seabed_min_m, p.above_seabed_max_m},
       {"sv_min_db", "sv_max_db", p.sv_min_db, p.sv_max_db},
       {"own_speed_min_mps", "own_speed_max_mps", p.own_speed_min_mps, p.own_speed_max_mps}}};
  for (const Span& span : spans) {
    if (span.least <= span.most) continue;
    return fail(ErrorCode::bad_parameter,
                fmt::format("{} = {} is more than {} = {}", span.least_name, span.least, span.most_name, span.most));
  }
  return {};
}

/// Each seed has a day of its own, so that surveys can be told apart.
TimeNs start_of(int seed) {
  constexpr TimeNs kDay = 86'400 * kSecondNs;
  return time_from_calendar(2020, 1, 1, 8.0 * 3600.0 + 0.35) + (seed % 3000) * kDay;
}

/// A scene with the survey's water, noise and ship, without course, schools or start of its own.
Scene scene_base(const SurveyParams& params, const std::vector<Beam>& beams, int observation) {
  Scene scene;
  scene.beams = sounding_beams(beams, params.beam_pattern);
  scene.beam_pattern = params.beam_pattern;
  scene.water = params.water;
  scene.noise = params.noise;
  scene.seed = static_cast<std::uint64_t>(params.seed);
  scene.observation = static_cast<std::uint32_t>(observation);
  scene.ping_interval_s = params.ping_interval_s;
  scene.pings = params.pings;
  scene.ship.speed_mps = params.speed_knots * kKnot_mps;
  scene.ship.yaw_deg = params.motion_deg;
  scene.ship.roll_deg = 3.0 * params.motion_deg;
  scene.ship.pitch_deg = params.motion_deg;
  scene.ship.origin = kArea;
  scene.first_ping = start_of(params.seed);
  scene.ship.log_start_nmi = 1000.0;
  return scene;
}

// The demo.
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

/// Two opposing transects past the same schools with an empty leg between them. School 1 is passed at 100 m, then at
/// 300 m; school 2 swims out through the aft side; on school 3 lie a beam with corrupted packets and interference.
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

}  // namespace

SurveyParams survey_params(Preset preset) {
  SurveyParams p;
  p.preset = preset;
  switch (preset) {
    case Preset::easy:
      easy(p);
      break;
    case Preset::standard:
      faults(p.noise, 1.0);
      break;
    case Preset::hard:
      hard(p);
      break;
    case Preset::demo:
      demo(p);
      break;
  }
  return p;
}

Result<std::vector<Scene>> survey_scenes(const SurveyParams& params, const std::vector<Beam>& beams) {
  if (auto ok = check(params); !ok) return pass_on(ok);
  if (beams.empty()) return fail(ErrorCode::bad_parameter, "there are no beams");
  if (params.preset == Preset::demo) return demo_scenes(params, beams);
  std::vector<Scene> scenes;
  RandomStream random(static_cast<std::uint64_t>(params.seed), Purpose::placement, 0xFFFFFFFFU);
  const double towards_deg = random.uniform(0.0, 360.0);
  for (int i = 0; i < params.observations; ++i) {
    Scene scene = scene_base(params, beams, i);
    scene.ship.origin = destination(kArea, kBetweenObservations_m * i, towards_deg);
    scene.ship.course_deg = random.uniform(0.0, 360.0);
    if (i > 0) follow_on(scenes.back(), params.gap_s, scene);
    if (params.schools > 0) place_schools(params, scene);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace sonar::synth
