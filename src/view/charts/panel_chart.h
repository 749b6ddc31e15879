// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

struct CurvePoint {
  double x = 0.0;
  double y = std::numeric_limits<double>::quiet_NaN();    ///< NaN: the curve is broken here
  double low = std::numeric_limits<double>::quiet_NaN();  ///< ends of a bar through the point; NaN = it has none
  double high = std::numeric_limits<double>::quiet_NaN();
};

struct ChartCurve {
  std::string name;  ///< in the key, once where several panels have it; empty = not there
  Rgba8 colour;
  bool muted = false;  ///< thin and broken
  bool dots = true;    ///< a disc at each point, for pointers too
  std::vector<CurvePoint> points;
};

/// A value of x that stands out.
struct ChartMark {
  double at = 0.0;
  Rgba8 colour;
  std::string name;  ///< in the key, as curves
};

/// A stretch of x that stands out.
struct ChartStretch {
  double from = 0.0;
  double to = 0.0;
  std::string name;
};

struct ChartPanel {
  std::string x_label;
  std::string y_label;
  double least_x = 1.0;  ///< of the axes' spans
  double least_y = 1.0;
  bool downwards = false;  ///< y, as depths do
  std::vector<ChartCurve> curves;
  std::vector<ChartMark> marks = {};
  std::optional<ChartStretch> stretch = {};
};

struct PanelChartData {
  std::string title;
  std::string below;    ///< the second line
  std::string caution;  ///< below the key; may be empty
  std::size_t across = 1;
  std::vector<ChartPanel> panels;
};

struct PanelChart {
  FrameDescription frame;
  std::vector<PlotFrame> plots;  ///< of the panels that have room, the first ones
  struct Place {
    PixelPoint at;
    std::size_t panel = 0;
    std::size_t curve = 0;
    std::size_t point = 0;
  };
  std::vector<Place> places;  ///< of all points that are drawn with discs
  /// The nearest within reach; null without one.
  [[nodiscard]] const Place* at(PixelPoint pixel, double reach_px) const;
};

/// Curves side by side, each panel with axes of its own. Panels without room are left out, and said to be.
/// errors  bad_parameter: too small a picture; not_found: no point is known
[[nodiscard]] Result<PanelChart> panel_chart(const PanelChartData& data, PixelSize size, const Theme& theme);

}  // namespace sonar
