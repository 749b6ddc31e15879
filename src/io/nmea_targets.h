// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/time.h"

namespace sonar {

/// A school as a chart or radar takes it. NaN = not known: its field stays empty.
struct NmeaTarget {
  int number = 0;  ///< its last two digits are told
  std::string name;
  TimeNs time = 0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double distance_m = 0.0;
  double bearing_deg = 0.0;  ///< from the ship, true
  double speed_mps = 0.0;    ///< over ground
  double course_deg = 0.0;   ///< true
  bool lost = false;         ///< else it is being tracked
};

/// Target latitude and longitude, "$SSTLL,...*hh\r\n": NMEA 0183, talker SS (a scanning sounder).
[[nodiscard]] std::string tll_sentence(const NmeaTarget& target);
/// Tracked target by distance and bearing, nautical miles and knots, "$SSTTM,...*hh\r\n".
[[nodiscard]] std::string ttm_sentence(const NmeaTarget& target);

}  // namespace sonar
