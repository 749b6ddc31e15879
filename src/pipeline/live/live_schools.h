// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "model/product.h"

namespace sonar {

/// A school as it stands while its observation goes on.
struct LiveSchool {
  SchoolRow school;                  ///< over its pings so far
  SchoolPingRow newest;              ///< where it was seen last
  PingNavigation ship;               ///< at that ping
  std::vector<SchoolPingRow> since;  ///< in the pings that came since the look before
  bool is_new = false;               ///< was not there at the look before
};

/// Schools of an observation that goes on: in the pings that came since the look before, or new. Those that a human rejected are not told.
/// before  what was known of it at the look before, its numbers kept since; null = nothing
[[nodiscard]] std::vector<LiveSchool> live_schools(const ObservationProduct& product, const ObservationProduct* before);

/// "obs-0001/3"
[[nodiscard]] std::string name_of(const LiveSchool& school);
/// "2026-11-26T12:35:19.000Z obs-0001/3: 182 m off at 271 deg, 45 m deep; 61.12345 4.56789; course 120 deg, 0.8 m/s;
/// 35 x 18 x 9 m, -52.3 dB"
[[nodiscard]] std::string school_line(const LiveSchool& school);

}  // namespace sonar
