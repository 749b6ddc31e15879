// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/nmea_targets.h"
#include "pipeline/live_schools.h"

namespace sonar {

/// Schools as targets for the bridge's chart: told while they are seen, and once more when they are lost.
/// threads  one
class LiveTargets {
 public:
  /// TLL and TTM of each school that is seen, and of those that were before and are not any more.
  [[nodiscard]] std::vector<std::string> sentences(std::span<const LiveSchool> seen);

 private:
  std::map<std::string, NmeaTarget> told_;  ///< by school
};

}  // namespace sonar
