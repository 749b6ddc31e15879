// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "signal/flag_kernels.h"
#include "signal/flags.h"

namespace sonar {

namespace {

/// The largest count of a row within `reach` of a sample.
int largest(std::span<const std::int16_t> row, int sample, int reach) {
  const int begin = std::max(sample - reach, 0);
  const int end = std::min(sample + reach + 1, static_cast<int>(row.size()));
  int value = kNoData;
  for (int i = begin; i < end; ++i) value = std::max<int>(value, row[static_cast<std::size_t>(i)]);
  return value;
}

bool above_neighbour_beams(View3<const std::int16_t> power, int row, int sample, int reach, int limit) {
  const Shape3 shape = power.shape();
  const int fan = row / shape.beams;
  const int beam = row % shape.beams;
  for (int f = std::max(fan - 1, 0); f <= std::min(fan + 1, shape.fans - 1); ++f) {
    for (int b = std::max(beam - 1, 0); b <= std::min(beam + 1, shape.beams - 1); ++b) {
      if ((f != fan || b != beam) && largest(power.row(f, b), sample, reach) >= limit) return false;
    }
  }
  return true;
}

/// Whether another ping shows something at the same place. Between two pings a ship moves by more than a sample, so the
/// place is a few samples wide. Interference, which most beams of the fan show, has no say: it hides what else is there.
bool shown_by(View3<const std::int16_t> other, Shape3 shape, int row, int sample, int reach, int limit) {
  if (other.shape() != shape || largest(other.row(row), sample, reach) < limit) return false;
  const int fan = row / shape.beams;
  int loud = 0;
  int recorded = 0;
  for (int b = 0; b < shape.beams; ++b) {
    const int level = largest(other.row(fan, b), sample, reach);
    recorded += level != kNoData ? 1 : 0;
    loud += level >= limit ? 1 : 0;
  }
  return 2 * loud <= recorded || recorded == 1;
}

}  // namespace

void flag_impulses(View3<const std::int16_t> power, const NeighbourPings& neighbours, const ImpulseParams& params,
                   View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape());
  if (!params.enabled) return;
  const Shape3 shape = power.shape();
  const auto threshold = static_cast<std::int16_t>(std::lround(counts_from_db(params.threshold_db)));
  std::vector<std::uint64_t> bits((static_cast<std::size_t>(shape.samples) + 63) / 64);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const auto counts = power.row(row);
    peak_bits(counts, threshold, bits);
    for (std::size_t word = 0; word < bits.size(); ++word) {
      for (std::uint64_t left = bits[word]; left != 0; left &= left - 1) {
        const int sample = static_cast<int>(word * 64) + std::countr_zero(left);
        const int limit = counts[static_cast<std::size_t>(sample)] - threshold;
        if (above_neighbour_beams(power, row, sample, params.beam_reach_samples, limit) &&
            !shown_by(neighbours.before, shape, row, sample, params.ping_reach_samples, limit) &&
            !shown_by(neighbours.after, shape, row, sample, params.ping_reach_samples, limit)) {
          flags.row(row)[static_cast<std::size_t>(sample)] |= SampleFlags::impulse;
        }
      }
    }
  }
}

}  // namespace sonar
