// SPDX-License-Identifier: Apache-2.0
#include "signal/column_quantiles.h"

#include "base/check.h"
#include "base/units.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/column_quantiles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "signal/lane_io-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

/// A vector's width of columns.
struct Columns {
  const std::int16_t* first;
  std::size_t stride;
  std::size_t rows;
  std::size_t count;  ///< beyond, lanes hold no data

  [[nodiscard]] HWY_INLINE Vec row(Counts d, std::size_t i) const {
    return load_some(d, first + i * stride, count, kNoData);
  }
};

/// In each lane the largest value from least to most with at most `rank` values below it, by halving.
Vec RankedValue(Counts d, const Columns& columns, Vec rank, Vec least, Vec most) {
  const hn::RebindToUnsigned<Counts> words;
  while (!hn::AllTrue(d, hn::Eq(least, most))) {
    const auto half = hn::BitCast(d, hn::ShiftRight<1>(hn::BitCast(words, hn::Sub(most, least))));
    const auto middle = hn::Sub(most, half);
    auto below = hn::Zero(d);
    for (std::size_t i = 0; i < columns.rows; ++i) {
      below = hn::Sub(below, hn::VecFromMask(d, hn::Lt(columns.row(d, i), middle)));
    }
    const auto too_high = hn::Gt(below, rank);
    // Where least has met most, middle is most, and has no more than `rank` values below it.
    least = hn::IfThenElse(too_high, least, middle);
    most = hn::IfThenElse(too_high, hn::Sub(middle, hn::Set(d, std::int16_t{1})), most);
  }
  return least;
}

void OfColumns(const Columns& columns, const double* shares, std::size_t number, std::int16_t* known,
               std::int16_t* quantiles, std::size_t quantile_stride) {
  const Counts d;
  const auto none = hn::Set(d, kNoData);
  auto data = hn::Zero(d);
  auto most = none;
  auto least = hn::Set(d, std::int16_t{32767});
  for (std::size_t i = 0; i < columns.rows; ++i) {
    const auto value = columns.row(d, i);
    const auto missing = hn::Eq(value, none);
    data = hn::Add(data, hn::AndNot(hn::VecFromMask(d, missing), hn::Set(d, std::int16_t{1})));
    most = hn::Max(most, value);
    least = hn::Min(least, hn::IfThenElse(missing, hn::Set(d, std::int16_t{32767}), value));
  }
  least = hn::Min(least, most);  // a column without data
  store_some(d, data, known, columns.count);
  HWY_ALIGN std::int16_t rank[hn::MaxLanes(Counts())] = {};
  for (std::size_t k = 0; k < number; ++k) {
    const auto rows = static_cast<int>(columns.rows);
    for (std::size_t lane = 0; lane < columns.count; ++lane) {
      // no data lies below all data, so it counts as that many values below
      rank[lane] = static_cast<std::int16_t>(rows - known[lane] + static_cast<int>(shares[k] * known[lane]));
    }
    store_some(d, RankedValue(d, columns, hn::Load(d, rank), least, most), quantiles + k * quantile_stride,
               columns.count);
  }
}

void ColumnQuantiles(const std::int16_t* matrix, std::size_t rows, std::size_t columns, const double* shares,
                     std::size_t number, std::int16_t* known, std::int16_t* quantiles) {
  const std::size_t lanes = hn::Lanes(Counts());
  for (std::size_t i = 0; i < columns; i += lanes) {
    // The last vector takes some columns again rather than being filled lane by lane.
    const std::size_t at = i + lanes > columns && columns >= lanes ? columns - lanes : i;
    OfColumns({matrix + at, columns, rows, HWY_MIN(lanes, columns - at)}, shares, number, known + at, quantiles + at,
              columns);
  }
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {

namespace {
HWY_EXPORT(ColumnQuantiles);
}  // namespace

void column_quantiles(std::span<const std::int16_t> matrix, std::span<const double> shares,
                      std::span<std::int16_t> known, std::span<std::int16_t> quantiles) {
  const std::size_t columns = known.size();
  SONAR_CHECK(quantiles.size() == shares.size() * columns);
  if (columns == 0) return;
  const std::size_t rows = matrix.size() / columns;
  SONAR_CHECK(rows * columns == matrix.size() && rows <= kMostRows);
  HWY_DYNAMIC_DISPATCH(ColumnQuantiles)
  (matrix.data(), rows, columns, shares.data(), shares.size(), known.data(), quantiles.data());
}

}  // namespace sonar
#endif  // HWY_ONCE
