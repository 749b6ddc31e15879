// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "base/time.h"

namespace sonar {

/// Schools one after the other while the ship keeps its course within 20 degrees.
struct CourseLeg {
  TimeNs first_time = 0;  ///< middle of the first school's sighting
  TimeNs last_time = 0;
  std::size_t schools = 0;
  double course_deg = 0.0;  ///< of the ship, mean
  double ship_mps = 0.0;
  double along_mps = 0.0;  ///< mean speed of the schools over ground along the ship's course
  double along_se_mps = 0.0;
  double cross_mps = 0.0;  ///< the same to starboard of it
  double cross_se_mps = 0.0;
};

/// What the schools' speeds say of how the sonar is mounted and of the sound speed, with standard errors.
struct SetupCheck {
  std::vector<CourseLeg> legs;
  std::size_t schools = 0;
  bool drift_known = false;     ///< false = the ship sailed one way, and the schools are taken not to drift
  double drift_east_mps = 0.0;  ///< common to all schools: current, and swimming that they have in common
  double drift_east_se_mps = 0.0;
  double drift_north_mps = 0.0;
  double drift_north_se_mps = 0.0;
  double own_speed_mps = 0.0;      ///< scatter of the schools' own velocities round that, on each axis
  double bearing_error_deg = 0.0;  ///< bearings from the ship are too large by this
  double bearing_error_se_deg = 0.0;
  double range_scale = 1.0;  ///< ranges are too long by this factor
  double range_scale_se = 0.0;
};

}  // namespace sonar
