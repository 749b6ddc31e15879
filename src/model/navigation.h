// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "base/time.h"
#include "base/units.h"
#include "geo/frames.h"

namespace sonar {

/// The ship at one ping. NaN = unknown. Position is the transducer's.
struct PingNavigation {
  TimeNs time = 0;
  Geographic transducer{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  double heading_deg = std::numeric_limits<double>::quiet_NaN();   ///< true
  double speed_mps = std::numeric_limits<double>::quiet_NaN();     ///< over ground
  double course_deg = std::numeric_limits<double>::quiet_NaN();    ///< over ground, true
  double distance_nmi = std::numeric_limits<double>::quiet_NaN();  ///< the vessel's log
  double pitch_deg = 0.0;                                          ///< positive bow up
  double roll_deg = 0.0;                                           ///< positive port up
  double heave_m = 0.0;                                            ///< positive down
  double transducer_depth_m = 0.0;                                 ///< heave included where the setting says so
  double gps_minus_clock_s = std::numeric_limits<double>::quiet_NaN();
  bool bad = false;  ///< the ping was not used

  [[nodiscard]] bool has_position() const { return transducer.latitude_deg == transducer.latitude_deg; }
  /// An unknown heading counts as north.
  [[nodiscard]] Placement placement() const {
    return {transducer, std::isnan(heading_deg) ? 0.0 : rad_from_deg(heading_deg), transducer_depth_m};
  }
};

}  // namespace sonar
