// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/result.h"
#include "view/charts/panel_chart.h"
#include "view/theme.h"

namespace sonar {

/// Mean Sv of one fan at its frequency.
struct FrequencyPoint {
  int fan = 0;
  double frequency_khz = 0.0;
  double sv_db = std::numeric_limits<double>::quiet_NaN();   ///< NaN: not above the background
  double low_db = std::numeric_limits<double>::quiet_NaN();  ///< quartiles of the pings; NaN = not told
  double high_db = std::numeric_limits<double>::quiet_NaN();
  std::int64_t pings = 0;
  std::int64_t samples = 0;
  double volume_m3 = 0.0;
};

/// A school's echo over frequency, or that of the water round it.
struct FrequencySeries {
  std::string name;
  Rgba8 colour;
  bool muted = false;  ///< of the water: thin and broken
  std::vector<FrequencyPoint> points;
};

struct FrequencyChartData {
  std::string title;
  std::string pings;  ///< "ping 12", "pings 3 to 20 (18)"
  std::vector<FrequencySeries> series;
};

/// What keeps a frequency response by fans from being one of the fish alone, in a sentence.
[[nodiscard]] const char* frequency_caution();

/// Sv over frequency: a line with points for each series, with bars from quartile to quartile.
/// errors  bad_parameter: too small a picture; not_found: no point whose Sv is known
/// out     one panel, whose curves are the series
[[nodiscard]] Result<PanelChart> frequency_chart(const FrequencyChartData& data, PixelSize size, const Theme& theme);

/// What is known of a point, in lines.
[[nodiscard]] std::string frequency_point_text(const FrequencySeries& series, const FrequencyPoint& point);

}  // namespace sonar
