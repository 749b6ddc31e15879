// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geo/frames.h"

namespace sonar {

/// An area on the Earth: rings, filled even-odd; each without the repeated first place. Empty = none.
struct GeoArea {
  std::vector<std::vector<Geographic>> rings;
  friend bool operator==(const GeoArea&, const GeoArea&) = default;
};

/// What an observation covered and found, seen from above.
struct ObservationOutlines {
  std::string observation;
  GeoArea swept;  ///< union of all pings' footprints: the search volume
  struct School {
    std::int64_t school_id = 0;
    GeoArea area;  ///< union of its masks over all pings
  };
  std::vector<School> schools;  ///< in the product's order
};

}  // namespace sonar
