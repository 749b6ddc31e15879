// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/time.h"
#include "base/units.h"
#include "geo/frames.h"
#include "model/navigation.h"

namespace sonar::synth {

/// The ship: a straight course at constant speed over ground, yawing, rolling and pitching a little.
struct Ship {
  Geographic origin{60.0, 4.0};  ///< of the scene's east, north, up
  Point<Enu> start_m;            ///< at the first ping; z is not used
  double course_deg = 0.0;       ///< over ground, true, at the start
  double speed_mps = 6.0 * kKnot_mps;
  double yaw_deg = 0.0;  ///< amplitudes
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double transducer_depth_m = 7.0;
  double log_start_nmi = 0.0;
};

/// Where the ship is when: the pings of one observation, without what they show.
struct Voyage {
  Ship ship;
  TimeNs first_ping = 1'600'000'000 * kSecondNs;
  double ping_interval_s = 5.0;
  int pings = 1;

  [[nodiscard]] double seconds_of(int ping) const { return ping_interval_s * ping; }
  [[nodiscard]] TimeNs time_of(int ping) const;
  [[nodiscard]] TimeNs time_at(double seconds) const;
};

/// The ship at some time, in the scene's frame (z = 0).
[[nodiscard]] Point<Enu> ship_at(const Voyage& voyage, double seconds);
/// The ship at some time as the instruments see it; transducer_depth_m is the true one.
[[nodiscard]] PingNavigation navigation_at(const Voyage& voyage, double seconds);
/// Sets time and log of an observation so that it follows another.
void follow_on(const Voyage& before, double gap_s, Voyage& next);

}  // namespace sonar::synth
