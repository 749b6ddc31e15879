// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/measured_pings.h"

namespace sonar {

/// Pings at which a propagation by hand ended only because it was asked no farther; empty = no such end.
struct ReachEnds {
  std::optional<std::int64_t> first;
  std::optional<std::int64_t> last;
};

/// A school as its masks through time; what a human decided about it comes along.
struct SchoolMasks {
  struct InPing {
    std::int64_t ping_index = 0;
    PingMask mask;
    double threshold_db = kUnknown;
  };
  std::vector<InPing> pings;  ///< rising
  std::int64_t track_id = 0;  ///< number among the tracked schools; 0 = a human's
  /// Origin, status, operator, decided_utc, species, comment, name, continues, ended_at_reach; the rest is measured.
  SchoolRow decided;
  ReachEnds reach;
  /// The masks that detection found, where humans took voxels of them; null = it has them all, or was not found.
  std::shared_ptr<const std::vector<InPing>> found = {};
};

/// SchoolRow::ended_at_reach: what is known of the ends holds while the school begins, or ends, there.
[[nodiscard]] std::string ended_at_reach(const SchoolMasks& school);

/// Numbers schools 1.. by (first ping, channel, sample) of their first voxel; those without pings are left out.
[[nodiscard]] std::vector<SchoolMasks> numbered(std::vector<SchoolMasks> schools, const BeamGrid& grid);

/// Adds the row of each school that has rows of pings in the product, after these were told how the school moved. Rows of one
/// school stand together.
void summarise_schools(const std::vector<SchoolMasks>& schools, const Recipe& recipe, ObservationProduct& product);

/// Measures every ping of numbered schools and summarises. Rows and masks are put into the product, sorted.
/// before  of the same engine, or of one that keeps keys of its pings; null = everything is measured
/// errors  cancelled. A ping that cannot be read any more loses its masks; it is noted and marked bad.
[[nodiscard]] Result<void> measure_schools(Engine& engine, std::vector<SchoolMasks> schools,
                                           ObservationProduct& product, Work& work, MeasuredPings* before = nullptr);

/// Pings that measure_schools() would have to measure, rising: their backgrounds must be estimated before.
[[nodiscard]] std::vector<std::int64_t> pings_to_measure(const Engine& engine, const std::vector<SchoolMasks>& schools,
                                                         const MeasuredPings& before);

}  // namespace sonar
