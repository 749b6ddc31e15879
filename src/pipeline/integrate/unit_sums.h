// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "school/integrate/cells.h"

namespace sonar {

/// A cell: range bin, depth channel.
using CellKey = std::pair<int, int>;

/// What the pings of one unit add up to.
struct UnitSums {
  std::map<CellKey, CellSums> cells;                       ///< those that the sector reaches, echo or not
  std::map<int, double> area_m2;                           ///< by range bin, over pings
  std::int64_t pings = 0;                                  ///< that were used
  std::set<std::pair<std::string, std::int64_t>> schools;  ///< observation and school_id of those seen
  bool schools_known = true;                               ///< schools were looked for in every ping that was used
  bool extinction_corrected = false;                       ///< what schools took out of the beams was given back

  void add(const PingCells& ping);
};

}  // namespace sonar
