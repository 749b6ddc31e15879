// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/nmea_targets.h"
#include "pipeline/live/live_schools.h"

namespace sonar {

/// Schools as targets for the bridge's chart: told while they are seen, and as lost when they were not for some looks.
/// threads  one
class LiveTargets {
 public:
  /// TLL and TTM of each school that is seen, and of those that are lost.
  [[nodiscard]] std::vector<std::string> sentences(std::span<const LiveSchool> seen);
  /// All are lost: what follows them ends.
  [[nodiscard]] std::vector<std::string> end();

 private:
  struct Told {
    NmeaTarget target;
    int missed = 0;  ///< looks
  };
  [[nodiscard]] int free_number() const;
  std::map<std::string, Told> told_;  ///< by school
};

}  // namespace sonar
