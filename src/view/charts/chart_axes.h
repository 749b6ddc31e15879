// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "view/axes.h"
#include "view/charts/chart_columns.h"

namespace sonar {

/// An axis of a chart: what its numbers are, and what a reader divides them by.
struct ChartAxis {
  ChartColumn column;
  double low = 0.0;
  double high = 1.0;
  int power = 0;      ///< ticks are in units of 10^power
  std::string label;  ///< with unit
  friend bool operator==(const ChartAxis&, const ChartAxis&) = default;
};
struct ChartTick {
  double at = 0.0;
  std::string text;
};

/// An axis over all known values, a little wider than they are; where all are equal, as wide as lets one read them.
/// from_zero  it begins at 0: of a count
[[nodiscard]] ChartAxis chart_axis(const ChartColumn& column, std::span<const double> values, bool from_zero = false);
/// The same axis over another part.
[[nodiscard]] ChartAxis part_of(ChartAxis axis, double low, double high);
/// At round numbers, or round times; at most so many.
[[nodiscard]] std::vector<ChartTick> chart_ticks(const ChartAxis& axis, int most);
/// As many as have room side by side.
[[nodiscard]] std::vector<ChartTick> ticks_across(const ChartAxis& axis, double width_px, const Theme& theme);
[[nodiscard]] std::vector<ChartTick> ticks_down(const ChartAxis& axis, double height_px, const Theme& theme);

/// Faint lines of both axes across the plot.
void add_chart_grid(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> x,
                    std::span<const ChartTick> y, const Theme& theme);
/// Frame, ticks outside, their texts, and the labels of the axes.
void add_chart_axes(FrameDescription& frame, const PlotFrame& plot, std::span<const ChartTick> x,
                    std::span<const ChartTick> y, const Theme& theme);

}  // namespace sonar
