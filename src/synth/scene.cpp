// SPDX-License-Identifier: Apache-2.0
#include "synth/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/geodesic.h"
#include "geo/sector.h"

namespace sonar::synth {
namespace {

constexpr double kYawPeriod_s = 47.0;
constexpr double kRollPeriod_s = 9.0;
constexpr double kPitchPeriod_s = 6.5;

double swing(double amplitude, double seconds, double period_s) {
  return amplitude * std::sin(2.0 * std::numbers::pi * seconds / period_s);
}

Point<Enu> course_velocity(const Ship& ship) {
  const double course = rad_from_deg(ship.course_deg);
  return {ship.speed_mps * std::sin(course), ship.speed_mps * std::cos(course), 0.0};
}

}  // namespace

TimeNs Scene::time_of(int ping) const { return time_at(seconds_of(ping)); }

TimeNs Scene::time_at(double seconds) const {
  return first_ping + static_cast<TimeNs>(std::llround(seconds * 1e4)) * (kSecondNs / 10'000);
}

Point<Enu> ship_at(const Scene& scene, double seconds) {
  Point<Enu> p = scene.ship.start_m + course_velocity(scene.ship) * seconds;
  p.z = 0.0;
  return p;
}

PingNavigation navigation_at(const Scene& scene, double seconds) {
  const Ship& ship = scene.ship;
  PingNavigation n;
  n.time = scene.time_at(seconds);
  n.transducer = to_geographic(ship_at(scene, seconds), scene.ship.origin);
  n.speed_mps = ship.speed_mps;
  // The course as it is on the spot: meridians converge, so a straight line does not keep its bearing.
  const Geographic ahead = to_geographic(
      ship_at(scene, seconds) + course_velocity(ship) * (100.0 / std::max(0.1, ship.speed_mps)), ship.origin);
  n.course_deg = ship.speed_mps > 0.0 ? geodesic(n.transducer, ahead).bearing_deg : wrap_360(ship.course_deg);
  n.heading_deg = wrap_360(n.course_deg + swing(ship.yaw_deg, seconds, kYawPeriod_s));
  n.roll_deg = swing(ship.roll_deg, seconds, kRollPeriod_s);
  n.pitch_deg = swing(ship.pitch_deg, seconds, kPitchPeriod_s);
  n.distance_nmi = ship.log_start_nmi + ship.speed_mps * seconds / kMetresPerNauticalMile;
  n.transducer_depth_m = ship.transducer_depth_m;
  n.gps_minus_clock_s = 0.0;
  return n;
}

Scene empty_scene(int pings) {
  Scene scene;
  scene.pings = pings;
  scene.water.reverberation_sv_db = -300.0;
  scene.water.surface_db = -400.0;
  scene.water.seabed_db = -400.0;
  scene.noise.speckle = false;
  scene.noise.background_power_db = -300.0;
  scene.noise.background_spread_db = 0.0;
  scene.noise.ringing_power_db = -400.0;
  return scene;
}

Point<Enu> place_seen(const Scene& scene, double range_m, double elevation_deg, double azimuth_deg) {
  const Point<Sonar> seen = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
  const PingNavigation n = navigation_at(scene, 0.0);
  Point<Enu> p = to_enu(seen, rad_from_deg(n.heading_deg)) + ship_at(scene, 0.0);
  p.z -= scene.ship.transducer_depth_m;
  return p;
}

}  // namespace sonar::synth
