// SPDX-License-Identifier: Apache-2.0
#include "synth/voyage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/geodesic.h"

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

TimeNs Voyage::time_of(int ping) const { return time_at(seconds_of(ping)); }

TimeNs Voyage::time_at(double seconds) const {
  return first_ping + static_cast<TimeNs>(std::llround(seconds * 1e4)) * (kSecondNs / 10'000);
}

Point<Enu> ship_at(const Voyage& voyage, double seconds) {
  Point<Enu> p = voyage.ship.start_m + course_velocity(voyage.ship) * seconds;
  p.z = 0.0;
  return p;
}

PingNavigation navigation_at(const Voyage& voyage, double seconds) {
  const Ship& ship = voyage.ship;
  PingNavigation n;
  n.time = voyage.time_at(seconds);
  n.transducer = to_geographic(ship_at(voyage, seconds), voyage.ship.origin);
  n.speed_mps = ship.speed_mps;
  // The course as it is on the spot: meridians converge, so a straight line does not keep its bearing.
  const Geographic ahead = to_geographic(
      ship_at(voyage, seconds) + course_velocity(ship) * (100.0 / std::max(0.1, ship.speed_mps)), ship.origin);
  n.course_deg = ship.speed_mps > 0.0 ? geodesic(n.transducer, ahead).bearing_deg : wrap_360(ship.course_deg);
  n.heading_deg = wrap_360(n.course_deg + swing(ship.yaw_deg, seconds, kYawPeriod_s));
  n.roll_deg = swing(ship.roll_deg, seconds, kRollPeriod_s);
  n.pitch_deg = swing(ship.pitch_deg, seconds, kPitchPeriod_s);
  n.distance_nmi = ship.log_start_nmi + ship.speed_mps * seconds / kMetresPerNauticalMile;
  n.transducer_depth_m = ship.transducer_depth_m;
  n.gps_minus_clock_s = 0.0;
  return n;
}

void follow_on(const Voyage& before, double gap_s, Voyage& next) {
  const double lasts_s = before.seconds_of(before.pings) + gap_s;
  next.first_ping = before.time_at(std::ceil(lasts_s));
  next.ship.log_start_nmi = before.ship.log_start_nmi + before.ship.speed_mps * lasts_s / kMetresPerNauticalMile;
}

}  // namespace sonar::synth
