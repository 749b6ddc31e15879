// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/place_statistics.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>

#include "signal/column_quantiles.h"
#include "signal/excess_kernels.h"
#include "signal/row_kernels.h"

namespace sonar {
namespace {

constexpr int kEnough = 60;  ///< values that tell a level and a spread
constexpr int kClear = 850;  ///< 10 dB, or 3.3 spreads
constexpr int kSkew = 2;
constexpr std::size_t kLeastRest = 4;  ///< a quarter: fewer may be beams that hear badly
constexpr std::size_t kPool = 3;       ///< places each side that lend theirs where there are fewer

constexpr std::array kShares = {0.5, 0.16, 0.84};

/// in  values of the ranks of kShares
PlaceStatistics statistics(std::int16_t middle, std::int16_t low, std::int16_t high) {
  return {middle, static_cast<std::int16_t>(middle - low), static_cast<std::int16_t>(high - middle)};
}

/// Of values, of which there are some.
PlaceStatistics percentiles(std::span<const std::int16_t> values) {
  std::int16_t least = values.front();
  std::int16_t most = values.front();
  for (const std::int16_t value : values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const auto at = [&](double share, std::int16_t from, std::int16_t to) {
    return select_rank(values, static_cast<std::size_t>(share * static_cast<double>(values.size())), from, to);
  };
  const std::int16_t middle = at(kShares[0], least, most);
  return statistics(middle, at(kShares[1], least, middle), at(kShares[2], middle, most));
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

/// The values of a fan, each place a column.
class FanValues {
 public:
  explicit FanValues(std::size_t places)
      : places_(places), known_(places), quantiles_(places * kShares.size()), data_(places) {}

  void clear() { matrix_.clear(); }

  /// The blocks of a beam whose places are theirs.
  void add(std::span<const std::int16_t> row, std::span<const std::uint8_t> marks) {
    copy_unmarked(row, marks, new_row().first(row.size()));
  }

  /// The levels of a beam in the middle of each place, between the blocks on either side; none where one of them has no say.
  void add_levels(std::span<const std::int16_t> row, std::span<const std::uint8_t> marks, float stretch) {
    heard_.resize(row.size());
    copy_unmarked(row, marks, heard_);
    const auto out = new_row();
    const auto last = static_cast<int>(row.size()) - 1;
    const auto end = static_cast<float>(last);
    for (std::size_t b = 0; b < out.size(); ++b) {
      const float at = (static_cast<float>(b) + 0.5F) / stretch - 0.5F;
      const auto block = static_cast<int>(std::clamp(at, 0.0F, end));
      const int from = heard_[static_cast<std::size_t>(block)];
      const int to = heard_[static_cast<std::size_t>(std::min(block + 1, last))];
      const float level = static_cast<float>(from) + (at - static_cast<float>(block)) * static_cast<float>(to - from);
      const bool known = (at >= 0.0F) & (at <= end) & (from != kNoData) & (to != kNoData);
      out[b] = static_cast<std::int16_t>(known ? static_cast<int>(level) : kNoData);
    }
  }

  /// The blocks of a beam, where several may have one place: in as many rows.
  void add_blocks(std::span<const std::int16_t> row, std::span<const std::uint8_t> marks, const Places& places,
                  std::size_t ping, int beam_row) {
    heard_.resize(row.size());
    copy_unmarked(row, marks, heard_);
    const std::size_t first = matrix_.size();
    std::ptrdiff_t in_row = 0;
    int last_place = -1;
    std::int16_t* to = matrix_.data();
    places.for_each(ping, beam_row, static_cast<int>(row.size()), [&, this](int block, int place) {
      in_row = place == last_place ? in_row + 1 : 0;
      last_place = place;
      const std::size_t start = first + static_cast<std::size_t>(in_row) * places_;
      if (start == matrix_.size()) {
        new_row();
        to = matrix_.data();
      }
      to[start + static_cast<std::size_t>(place)] = heard_[static_cast<std::size_t>(block)];
    });
  }

  [[nodiscard]] std::vector<PlaceStatistics> tell(Trend trend) {
    for (std::vector<std::int16_t>& column : data_) column.clear();
    column_quantiles(matrix_, kShares, known_, quantiles_);
    std::vector<PlaceStatistics> told(places_);
    for (std::size_t b = 0; b < places_; ++b) {
      told[b] = known_[b] >= kEnough ? of_place(b, trend) : of_several(b);
    }
    return told;
  }

 private:
  std::span<std::int16_t> new_row() {
    matrix_.resize(matrix_.size() + places_, kNoData);
    return std::span(matrix_).last(places_);
  }

  /// The data of a column; told again, they need not be looked for again.
  const std::vector<std::int16_t>& data(std::size_t place) {
    std::vector<std::int16_t>& column = data_[place];
    if (!column.empty() || known_[place] == 0) return column;
    for (std::size_t at = place; at < matrix_.size(); at += places_) {
      if (matrix_[at] != kNoData) column.push_back(matrix_[at]);
    }
    return column;
  }

  /// Water has its outliers above, and without its trend it is about 0. Where most values of one place stand clear of the
  /// others, as of a school that a ship at rest looks at, the others are the water; not where places had to be joined, for
  /// their levels differ.
  [[nodiscard]] PlaceStatistics of_place(std::size_t b, Trend trend) {
    const PlaceStatistics all = statistics(quantiles_[b], quantiles_[places_ + b], quantiles_[2 * places_ + b]);
    const bool clear = trend == Trend::steep ? all.below >= kSkew * all.above : all.middle >= kClear;
    if (!clear || all.below < kClear) return all;
    std::vector<std::int16_t> low = data(b);
    const std::size_t number = low.size();
    std::erase_if(low, [&](std::int16_t value) { return value >= all.middle - all.below / 2; });
    return low.size() < number / kLeastRest ? all : percentiles(low);
  }

  [[nodiscard]] PlaceStatistics of_several(std::size_t b) {
    std::size_t first = b;
    std::size_t last = b;
    int number = known_[b];
    for (std::size_t r = 1; r <= kPool && number < kEnough; ++r) {
      if (b >= r) number += known_[first = b - r];
      if (b + r < places_) number += known_[last = b + r];
    }
    if (number < kEnough) return {};
    std::vector<std::int16_t> pooled;
    for (std::size_t place = first; place <= last; ++place) {
      pooled.insert(pooled.end(), data(place).begin(), data(place).end());
    }
    return percentiles(pooled);
  }

  std::size_t places_;
  std::vector<std::int16_t> matrix_;  ///< [beam of a ping][place]; kNoData has no say
  std::vector<std::int16_t> heard_;   ///< [block] of one beam
  std::vector<std::int16_t> known_;   ///< [place]
  std::vector<std::int16_t> quantiles_;
  std::vector<std::vector<std::int16_t>> data_;  ///< [place]; empty = not told yet
};

}  // namespace

std::vector<PlaceStatistics> statistics_of_places(const std::vector<Array3<std::int16_t>>& of_pings,
                                                  const std::vector<Array3<std::uint8_t>>& masked, const Places& places,
                                                  Trend trend) {
  if (of_pings.empty()) return {};
  const Shape3 shape = of_pings.front().shape();
  // Of thousands of beams every second or third tells as much; a stretched one takes two rows.
  const auto rows = [&](int step) { return 2 * std::ssize(of_pings) * ((shape.beams + step - 1) / step); };
  int step = 1;
  while (step < shape.beams && rows(step) > std::ptrdiff_t{kMostRows}) ++step;
  FanValues values(static_cast<std::size_t>(places.count()));
  std::vector<PlaceStatistics> told;
  for (int fan = 0; fan < shape.fans; ++fan) {
    values.clear();
    for (std::size_t p = 0; p < of_pings.size(); ++p) {
      for (int beam = 0; beam < shape.beams; beam += step) {
        const auto row = of_pings[p].row(fan, beam);
        const auto marks = masked[p].row(fan, beam);
        const float stretch = places.stretch(p, fan * shape.beams + beam);
        if (stretch == 1.0F) {
          values.add(row, marks);
        } else if (trend == Trend::steep) {
          values.add_levels(row, marks, stretch);
        } else {
          values.add_blocks(row, marks, places, p, fan * shape.beams + beam);
        }
      }
    }
    std::vector<PlaceStatistics> of_fan = values.tell(trend);
    fill(of_fan);
    told.insert(told.end(), of_fan.begin(), of_fan.end());
  }
  return told;
}

}  // namespace sonar
