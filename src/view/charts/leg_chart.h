// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// Mean speed of the schools on one course of the ship, with standard errors.
struct LegSpeed {
  std::string begins;  ///< UTC
  double course_deg = 0.0;
  double ship_mps = 0.0;
  std::size_t schools = 0;
  double along_mps = 0.0;  ///< along the ship's course
  double along_se_mps = 0.0;
  double cross_mps = 0.0;  ///< to starboard of it
  double cross_se_mps = 0.0;
};

struct LegChartData {
  std::string title;
  std::vector<LegSpeed> legs;
  std::vector<std::string> words;  ///< lines below the chart: what is proposed
};

struct LegChart {
  FrameDescription frame;
  PlotFrame plot;  ///< leg i at x = i + 1
  /// The leg under a place.
  [[nodiscard]] std::optional<std::size_t> leg_at(const LegChartData& data, PixelPoint at) const;
};

/// Mean along- and cross-track speed of the schools on each course leg, with bars of one standard error: where the sonar is
/// set up well and nothing drifts, all are 0.
/// errors  bad_parameter: too small a picture; not_found: no leg
[[nodiscard]] Result<LegChart> leg_chart(const LegChartData& data, PixelSize size, const Theme& theme);

/// What is known of a leg, in lines.
[[nodiscard]] std::string leg_text(const LegSpeed& leg, const Units& units = {});

}  // namespace sonar
