// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "view/charts/chart_columns.h"

namespace sonar {

inline constexpr int kMostBins = 200;

/// Bins of a histogram: bin i holds edges[i] <= value < edges[i + 1].
struct ChartBins {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<double> edges;            ///< rising, multiples of one round number; one more than there are bins
  std::vector<std::size_t> bin_of_row;  ///< [row]; kNone where the value is unknown

  [[nodiscard]] std::size_t count() const { return edges.empty() ? 0 : edges.size() - 1; }
};

/// Bins over all values that are known. Their width is the round number (1, 2 or 5 times a power of ten; of times a round
/// number of seconds, minutes, hours or days; of whole numbers at least 1) next to the one that is asked for.
/// column  its unit_size too: round numbers are of the unit that is read, edges are in the table's
/// about   how many bins; 0 = by the rule of Freedman and Diaconis (1981): 2 IQR / n^(1/3) wide, or, where half of the
///         values are equal, as many as Sturges (1926) has it
/// out     no bins without a value
[[nodiscard]] ChartBins chart_bins(std::span<const double> values, const ChartColumn& column, int about);

}  // namespace sonar
