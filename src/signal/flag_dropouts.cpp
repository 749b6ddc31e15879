// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/check.h"
#include "base/units.h"
#include "signal/flag_kernels.h"
#include "signal/flags.h"

namespace sonar {

namespace {

using Row = std::span<const std::int16_t>;

/// Flags the stretches of at least `minimum` samples where same(i) holds. A stretch that long holds a probe at some
/// multiple of its half, so that most samples are never looked at.
template <class Same>
void flag_stretches(std::size_t size, std::size_t minimum, const Same& same, std::span<SampleFlags> flags) {
  std::size_t done = 0;
  for (std::size_t probe = 0; probe < size; probe += std::max<std::size_t>(minimum / 2, 1)) {
    if (probe < done || !same(probe)) continue;
    std::size_t first = probe;
    std::size_t end = probe + 1;
    while (first > done && same(first - 1)) --first;
    while (end < size && same(end)) ++end;
    if (end - first >= minimum) {
      for (std::size_t i = first; i < end; ++i) flags[i] |= SampleFlags::dropout;
    }
    done = end;
  }
}

}  // namespace

void flag_dropouts(View3<const std::int16_t> power, const DropoutParams& params, View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape());
  const auto minimum = static_cast<std::size_t>(std::max(params.minimum_samples, 2));
  const Shape3 shape = power.shape();
  for (int r = 0; r < static_cast<int>(shape.rows()); ++r) {
    const Row row = power.row(r);
    const auto row_flags = flags.row(r);
    flag_no_data(row, row_flags);
    if (!params.enabled || row.size() < 2) continue;
    // Sample i is like the next one; the last of a constant stretch is one further and stays.
    flag_stretches(
        row.size() - 1, minimum - 1, [&](std::size_t i) { return row[i] == row[i + 1] && row[i] != kNoData; },
        row_flags);
    if (r % shape.beams == 0) continue;
    const Row before = power.row(r - 1);
    flag_stretches(
        row.size(), minimum, [&](std::size_t i) { return row[i] == before[i] && row[i] != kNoData; }, row_flags);
  }
}

}  // namespace sonar
