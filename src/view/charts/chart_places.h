// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "view/axes.h"

namespace sonar {

/// What lies where on a chart, for pointers.
struct ChartPlaces {
  /// A bar of a histogram, as it is drawn: everything between two values.
  struct Bar {
    PixelRect place;
    double from = 0.0;
    double to = 0.0;
    std::vector<std::size_t> rows;
  };
  PlotFrame plot;
  std::vector<PixelPoint> points;  ///< [row] of a chart with two columns; NaN = left out, or outside the plot
  std::vector<Bar> bars;           ///< of a histogram, those that hold something and are in sight
  double reach_px = 0.0;           ///< how far from a point a pointer may be
};

/// Rows whose points lie in a rectangle, edges included; of a histogram those of every bar that it meets. In their order.
/// between  two opposite corners, in any order
[[nodiscard]] std::vector<std::size_t> rows_within(const ChartPlaces& places, PixelPoint a, PixelPoint b);
/// The row whose point is nearest, within reach.
[[nodiscard]] std::optional<std::size_t> row_at(const ChartPlaces& places, PixelPoint at);
/// The bar under a place; null without one.
[[nodiscard]] const ChartPlaces::Bar* bar_at(const ChartPlaces& places, PixelPoint at);

}  // namespace sonar
