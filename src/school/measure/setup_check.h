// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "model/navigation.h"
#include "model/school.h"
#include "school/measure/line_fit.h"
#include "school/measure/summarise.h"

namespace sonar {

/// How fast a school seemed to move over ground, and how fast the ship sailed in the same pings.
struct SeenSpeed {
  TimeNs time = 0;
  LineFit school;  ///< slopes east, north, m/s, and their variances
  double ship_east_mps = 0.0;
  double ship_north_mps = 0.0;
};

/// rows    of one school, rising time
/// pings   of its observation, by ping index
/// params  how long a school must be seen for a speed
/// out     none where it was not seen long enough, or the ship's positions are not known
[[nodiscard]] std::optional<SeenSpeed> seen_speed(std::span<const SchoolPingRow> rows,
                                                  std::span<const PingNavigation> pings, const SummariseParams& params);

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

/// A sonar that sees relative places turned clockwise by a and k times too far sees a target of velocity W from a ship of
/// velocity V move by k R(a) W + (I - k R(a)) V: what goes with the ship's velocity is the setup's, what does not is the
/// water's and the fish's. Both are fitted to all schools by generalised least squares; schools also swim each its own
/// way, with a variance found by restricted likelihood.
/// errors  not_found: fewer than three schools, or a ship that lies still
/// source  Harville 1977, JASA 72, 320 (restricted likelihood)
[[nodiscard]] Result<SetupCheck> check_setup(std::vector<SeenSpeed> seen);

}  // namespace sonar
