// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "view/axes.h"
#include "view/frame_description.h"
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

struct FrequencyChart {
  FrameDescription frame;
  PlotFrame plot;
  struct Place {
    PixelPoint at;
    std::size_t series = 0;
    std::size_t point = 0;
  };
  std::vector<Place> places;  ///< of all points that are drawn
  /// The nearest within reach; null without one.
  [[nodiscard]] const Place* at(PixelPoint pixel, double reach_px) const;
};

/// What keeps a frequency response by fans from being one of the fish alone, in a sentence.
[[nodiscard]] const char* frequency_caution();

/// Sv over frequency: a line with points for each series, with bars from quartile to quartile.
/// errors  bad_parameter: too small a picture; not_found: no point whose Sv is known
[[nodiscard]] Result<FrequencyChart> frequency_chart(const FrequencyChartData& data, PixelSize size,
                                                     const Theme& theme);

/// What is known of a point, in lines.
[[nodiscard]] std::string frequency_point_text(const FrequencySeries& series, const FrequencyPoint& point);

}  // namespace sonar
