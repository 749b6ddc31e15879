// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "model/navigation.h"
#include "model/school.h"
#include "model/setup_check.h"
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

/// A sonar that sees relative places turned clockwise by a and k times too far sees a target of velocity W from a ship of
/// velocity V move by k R(a) W + (I - k R(a)) V: what goes with the ship's velocity is the setup's, what does not is the
/// water's and the fish's. Both are fitted to all schools by generalised least squares; schools also swim each its own
/// way, with a variance found by restricted likelihood.
/// errors  not_found: fewer than three schools, or a ship that lies still
/// source  Harville 1977, JASA 72, 320 (restricted likelihood)
[[nodiscard]] Result<SetupCheck> check_setup(std::vector<SeenSpeed> seen);

}  // namespace sonar
