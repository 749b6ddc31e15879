// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "base/result.h"
#include "view/charts/chart_data.h"
#include "view/charts/chart_places.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// Part of a chart that is looked at, in the columns' values.
struct ChartPart {
  double x_low = 0.0;
  double x_high = 0.0;
  double y_low = 0.0;  ///< of a histogram not looked at: its counts begin at 0
  double y_high = 0.0;
  friend bool operator==(const ChartPart&, const ChartPart&) = default;
};

struct ChartStyle {
  int bins = 0;                         ///< about so many, of a histogram; 0 = automatic
  std::set<ChartSchool> selected = {};  ///< stand out, the others step back; empty = all are alike
  std::optional<ChartPart> shown = {};  ///< empty = everything
  bool brief = false;                   ///< title and key only where there is room: a window has its own
  double reach_px = 8.0;                ///< how far from a point a pointer may be
};

struct Chart {
  FrameDescription frame;
  ChartPlaces places;
  ChartPart whole;  ///< what is shown where nothing is said of a part
};

/// A histogram of one column, or one column over another: each row a point in the colour of its school, rejected ones
/// hollow and grey; over pings and times the points of one school in pings that follow one another are joined. Depths run
/// downwards. The title counts the rows, and those that are left out because a value is unknown.
/// cost    linear in rows; points that fall on one another are drawn once
/// errors  bad_parameter: too small a picture; not_found: no rows, or none whose values are known
[[nodiscard]] Result<Chart> chart(const ChartData& data, const ChartStyle& style, PixelSize size, const Theme& theme);

}  // namespace sonar
