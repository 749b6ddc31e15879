// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/engine.h"

namespace sonar {

/// A school as its masks through time; what a human decided about it comes along.
struct SchoolMasks {
  struct InPing {
    std::int64_t ping_index = 0;
    PingMask mask;
    double threshold_db = kUnknown;
  };
  std::vector<InPing> pings;  ///< rising
  SchoolRow decided;          ///< origin, status, operator, decided_utc, species, comment; the rest is measured
};

/// Numbers schools by (first ping, channel, sample) of their first voxel, measures every ping and summarises. Rows and
/// masks are put into the product, sorted. Schools without pings are left out.
/// errors  cancelled. A ping that cannot be read has no row; it is noted and marked bad.
[[nodiscard]] Result<void> measure_schools(Engine& engine, std::vector<SchoolMasks> schools,
                                           ObservationProduct& product, Work& work);

/// Measures and summarises schools that have their numbers already.
[[nodiscard]] Result<void> measure_numbered(Engine& engine, std::vector<SchoolMasks> schools,
                                            ObservationProduct& product, Work& work);

}  // namespace sonar
