// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonar {

/// A stretch of samples along one beam.
struct SampleRun {
  std::int32_t first = 0;
  std::int32_t count = 0;
  friend bool operator==(const SampleRun&, const SampleRun&) = default;
};

/// Appends the runs of samples at or above a limit, in order; kNoData is below every limit.
/// in      counts [sample]; limit in the same counts
void append_runs(std::span<const std::int16_t> counts, std::int16_t limit, std::vector<SampleRun>& runs);

/// The same with a limit for each sample; the shorter of the two spans ends the row. A limit of kNoData admits none.
void append_runs(std::span<const std::int16_t> counts, std::span<const std::int16_t> limit,
                 std::vector<SampleRun>& runs);

}  // namespace sonar
