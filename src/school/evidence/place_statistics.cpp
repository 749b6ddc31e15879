// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/place_statistics.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "signal/row_kernels.h"

namespace sonar {
namespace {

constexpr std::size_t kEnough = 60;  ///< values that tell a level and a spread
constexpr std::size_t kPool = 3;     ///< places each side that lend theirs where there are fewer

PlaceStatistics told_by(std::span<const std::int16_t> values) {
  if (values.size() < kEnough) return {};
  std::int16_t least = values.front();
  std::int16_t most = values.front();
  for (const std::int16_t value : values) {  // a shape that compilers turn into vector instructions
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const auto at = [&](double share, std::int16_t from, std::int16_t to) {
    return select_rank(values, static_cast<std::size_t>(share * static_cast<double>(values.size())), from, to);
  };
  const std::int16_t middle = at(0.5, least, most);
  return {middle, static_cast<std::int16_t>(middle - at(0.16, least, middle)),
          static_cast<std::int16_t>(at(0.84, middle, most) - middle)};
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
                                                  const std::vector<Array3<std::uint8_t>>& masked,
                                                  const Places& places) {
  if (of_pings.empty()) return {};
  const Shape3 shape = of_pings.front().shape();
  const auto count = static_cast<std::size_t>(places.count());
  std::vector<PlaceStatistics> told(static_cast<std::size_t>(shape.fans) * count);
  const std::size_t most = of_pings.size() * static_cast<std::size_t>(shape.beams * places.most_blocks());
  std::vector<std::int16_t> values(count * most + 1);
  std::vector<std::size_t> known(count);
  const auto of_place = [&](std::size_t b) { return std::span(values).subspan(b * most, known[b]); };
  std::vector<std::int16_t> pooled;
  for (int fan = 0; fan < shape.fans; ++fan) {
    const std::size_t first = static_cast<std::size_t>(fan) * count;
    std::ranges::fill(known, 0);
    for (std::size_t p = 0; p < of_pings.size(); ++p) {
      for (int beam = 0; beam < shape.beams; ++beam) {
        const auto row = of_pings[p].row(fan, beam);
        const auto marks = masked[p].row(fan, beam);
        places.for_each(p, fan * shape.beams + beam, shape.samples, [&](int block, int at) {
          const auto b = static_cast<std::size_t>(block);
          const auto place = static_cast<std::size_t>(at);
          values[place * most + known[place]] = row[b];
          known[place] += row[b] != kNoData && marks[b] == 0 ? std::size_t{1} : std::size_t{0};
        });
      }
    }
    for (std::size_t b = 0; b < count; ++b) {
      PlaceStatistics& here = told[first + b];
      if (known[b] >= kEnough) {
        here = told_by(of_place(b));
        continue;
      }
      pooled.assign(of_place(b).begin(), of_place(b).end());
      for (std::size_t r = 1; r <= kPool && pooled.size() < kEnough; ++r) {
        if (b >= r) pooled.insert(pooled.end(), of_place(b - r).begin(), of_place(b - r).end());
        if (b + r < count) pooled.insert(pooled.end(), of_place(b + r).begin(), of_place(b + r).end());
      }
      here = told_by(pooled);
    }
    fill(std::span(told).subspan(first, count));
  }
  return told;
}

}  // namespace sonar
