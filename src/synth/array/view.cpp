// SPDX-License-Identifier: Apache-2.0
#include "synth/array/view.h"

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar::synth::array {

Point<Enu> View::from_transducer(const Point<Enu>& in_scene) const {
  Point<Enu> p = to_enu(to_geographic(in_scene, origin), navigation.transducer);
  p.z = in_scene.z - transducer_m.z;
  return p;
}

Point<Enu> View::in_scene(const Point<Enu>& from_transducer) const { return from_transducer + transducer_m; }

Point<Vessel> View::along_ship(const Point<Enu>& p) const {
  const double s = std::sin(heading_rad);
  const double c = std::cos(heading_rad);
  return {p.x * s + p.y * c, p.x * c - p.y * s, -p.z};
}

Point<Enu> View::from_ship(double bow, double port, double up) const {
  const double s = std::sin(heading_rad);
  const double c = std::cos(heading_rad);
  return {bow * s - port * c, bow * c + port * s, up};
}

Direction View::heard(const Point<Enu>& p) const {
  const Point<Vessel> v = along_ship(p);
  const double bow = v.x;
  const double port = -v.y;
  const double level = std::hypot(bow, port);
  // An arc of radius c / gradient over a level way leaves by half its angle off the chord.
  const double bent = gradient_per_s * level / (2.0 * kSoundSpeed_mps);
  const double up = -v.z - level * std::tan(bent);
  const double pitched_bow = bow * std::cos(pitch_rad) + up * std::sin(pitch_rad);
  const double pitched_up = up * std::cos(pitch_rad) - bow * std::sin(pitch_rad);
  const double rolled_port = port * std::cos(roll_rad) + pitched_up * std::sin(roll_rad);
  const double rolled_up = pitched_up * std::cos(roll_rad) - port * std::sin(roll_rad);
  const double r = std::sqrt(pitched_bow * pitched_bow + rolled_port * rolled_port + rolled_up * rolled_up);
  return r > 0.0 ? Direction{pitched_bow / r, rolled_up / r, rolled_port / r} : Direction{0.0, 0.0, 1.0};
}

View view_of(const Voyage& voyage, int ping, double unsteady, double gradient_per_s) {
  constexpr double kRollPeriod_s = 8.3;
  constexpr double kPitchPeriod_s = 5.9;
  View v;
  v.seconds = voyage.seconds_of(ping);
  v.navigation = navigation_at(voyage, v.seconds);
  v.origin = voyage.ship.origin;
  v.transducer_m = ship_at(voyage, v.seconds);
  v.transducer_m.z = -v.navigation.transducer_depth_m;
  v.heading_rad = rad_from_deg(v.navigation.heading_deg);
  v.roll_rad = rad_from_deg(unsteady) * std::sin(2.0 * std::numbers::pi * v.seconds / kRollPeriod_s);
  v.pitch_rad = rad_from_deg(0.5 * unsteady) * std::sin(2.0 * std::numbers::pi * v.seconds / kPitchPeriod_s);
  v.gradient_per_s = gradient_per_s;
  return v;
}

}  // namespace sonar::synth::array
