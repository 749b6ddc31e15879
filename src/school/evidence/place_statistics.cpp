// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/place_statistics.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include "signal/row_kernels.h"

namespace sonar {
namespace {

constexpr std::size_t kEnough = 60;  ///< values that tell a level and a spread
constexpr int kClear = 850;          ///< 10 dB, or 3.3 spreads
constexpr int kSkew = 2;
constexpr std::size_t kLeastRest = 4;  ///< a quarter: fewer may be beams that hear badly
constexpr std::size_t kPool = 3;       ///< places each side that lend theirs where there are fewer

/// Percentiles of values, of which there are some.
PlaceStatistics percentiles(std::span<const std::int16_t> values) {
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

/// Water has its outliers above, and without its trend it is about 0. Where most values of one place stand clear of the others,
/// as of a school that a ship at rest looks at, the others are the water; not where places had to be joined, for their levels
/// differ.
PlaceStatistics told_by(std::span<const std::int16_t> values, Trend trend) {
  const PlaceStatistics all = percentiles(values);
  const bool clear = trend == Trend::steep ? all.below >= kSkew * all.above : all.middle >= kClear;
  if (!clear || all.below < kClear) return all;
  std::vector<std::int16_t> low;
  std::ranges::copy_if(values, std::back_inserter(low), [&](std::int16_t v) { return v < all.middle - all.below / 2; });
  return low.size() < values.size() / kLeastRest ? all : percentiles(low);
}

/// The level at a fractional block; kNoData where a block that it needs has no say.
std::int16_t level_at(std::span<const std::int16_t> row, std::span<const std::uint8_t> marks, float at) {
  if (!(at >= 0.0F) || at > static_cast<float>(row.size() - 1)) return kNoData;
  const auto b = static_cast<std::size_t>(at);
  const std::size_t next = std::min(b + 1, row.size() - 1);
  if (row[b] == kNoData || row[next] == kNoData || marks[b] != 0 || marks[next] != 0) return kNoData;
  const float share = at - static_cast<float>(b);
  return static_cast<std::int16_t>(static_cast<float>(row[b]) + share * static_cast<float>(row[next] - row[b]));
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
                                                  const std::vector<Array3<std::uint8_t>>& masked, const Places& places,
                                                  Trend trend) {
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
        const auto add = [&](std::size_t place, std::int16_t value, bool counts) {
          values[place * most + known[place]] = value;
          known[place] += counts ? std::size_t{1} : std::size_t{0};
        };
        const float stretch = places.stretch(p, fan * shape.beams + beam);
        if (trend == Trend::steep && stretch != 1.0F) {
          for (std::size_t place = 0; place < count; ++place) {
            const std::int16_t value = level_at(row, marks, (static_cast<float>(place) + 0.5F) / stretch - 0.5F);
            add(place, value, value != kNoData);
          }
          continue;
        }
        places.for_each(p, fan * shape.beams + beam, shape.samples, [&](int block, int at) {
          const auto b = static_cast<std::size_t>(block);
          add(static_cast<std::size_t>(at), row[b], row[b] != kNoData && marks[b] == 0);
        });
      }
    }
    for (std::size_t b = 0; b < count; ++b) {
      PlaceStatistics& here = told[first + b];
      if (known[b] >= kEnough) {
        here = told_by(of_place(b), trend);
        continue;
      }
      pooled.assign(of_place(b).begin(), of_place(b).end());
      for (std::size_t r = 1; r <= kPool && pooled.size() < kEnough; ++r) {
        if (b >= r) pooled.insert(pooled.end(), of_place(b - r).begin(), of_place(b - r).end());
        if (b + r < count) pooled.insert(pooled.end(), of_place(b + r).begin(), of_place(b + r).end());
      }
      here = pooled.size() < kEnough ? PlaceStatistics{} : percentiles(pooled);
    }
    fill(std::span(told).subspan(first, count));
  }
  return told;
}

}  // namespace sonar
