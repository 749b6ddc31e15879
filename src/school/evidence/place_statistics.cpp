// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/place_statistics.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "signal/row_kernels.h"

namespace sonar {
namespace {

constexpr std::size_t kEnough = 60;  ///< values that tell a level and a spread
constexpr std::size_t kPool = 3;     ///< blocks each side that lend theirs where there are fewer

PlaceStatistics told_by(std::span<const std::int16_t> values) {
  if (values.size() < kEnough) return {};
  const auto at = [&](double share) {
    return select_rank(values, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  };
  const std::int16_t middle = at(0.5);
  return {middle, static_cast<std::int16_t>(middle - at(0.16)), static_cast<std::int16_t>(at(0.84) - middle)};
}

/// Where nothing is told, as behind a school that fills a fan, the water goes on between what lies nearer and farther.
void fill(std::span<PlaceStatistics> told) {
  std::ptrdiff_t last = -1;
  for (std::ptrdiff_t b = 0; b < std::ssize(told); ++b) {
    const PlaceStatistics here = told[static_cast<std::size_t>(b)];
    if (here.middle == kNoData) continue;
    for (std::ptrdiff_t i = last + 1; last >= 0 && i < b; ++i) {
      const PlaceStatistics before = told[static_cast<std::size_t>(last)];
      const auto between = [&](int from, int to) {
        return static_cast<std::int16_t>(from + (to - from) * (i - last) / (b - last));
      };
      told[static_cast<std::size_t>(i)] = {between(before.middle, here.middle), between(before.below, here.below),
                                           between(before.above, here.above)};
    }
    last = b;
  }
}

}  // namespace

std::vector<PlaceStatistics> statistics_of_places(const std::vector<Array3<std::int16_t>>& of_pings,
                                                  const std::vector<Array3<std::uint8_t>>& masked) {
  if (of_pings.empty()) return {};
  const Shape3 shape = of_pings.front().shape();
  std::vector<PlaceStatistics> told(static_cast<std::size_t>(shape.fans) * static_cast<std::size_t>(shape.samples));
  const auto blocks = static_cast<std::size_t>(shape.samples);
  const std::size_t most = of_pings.size() * static_cast<std::size_t>(shape.beams);
  std::vector<std::int16_t> values(blocks * most + 1);
  std::vector<std::size_t> known(blocks);
  const auto of_block = [&](std::size_t b) { return std::span(values).subspan(b * most, known[b]); };
  std::vector<std::int16_t> pooled;
  for (int fan = 0; fan < shape.fans; ++fan) {
    const std::size_t first = static_cast<std::size_t>(fan) * blocks;
    std::ranges::fill(known, 0);
    for (std::size_t p = 0; p < of_pings.size(); ++p) {
      for (int beam = 0; beam < shape.beams; ++beam) {
        const auto row = of_pings[p].row(fan, beam);
        const auto marks = masked[p].row(fan, beam);
        for (std::size_t b = 0; b < blocks; ++b) {
          values[b * most + known[b]] = row[b];
          known[b] += row[b] != kNoData && marks[b] == 0 ? std::size_t{1} : std::size_t{0};
        }
      }
    }
    for (std::size_t b = 0; b < blocks; ++b) {
      PlaceStatistics& here = told[first + b];
      if (known[b] >= kEnough) {
        here = told_by(of_block(b));
        continue;
      }
      pooled.assign(of_block(b).begin(), of_block(b).end());
      for (std::size_t r = 1; r <= kPool && pooled.size() < kEnough; ++r) {
        if (b >= r) pooled.insert(pooled.end(), of_block(b - r).begin(), of_block(b - r).end());
        if (b + r < blocks) pooled.insert(pooled.end(), of_block(b + r).begin(), of_block(b + r).end());
      }
      here = told_by(pooled);
    }
    fill(std::span(told).subspan(first, blocks));
  }
  return told;
}

}  // namespace sonar
