// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "view/timeline.h"

namespace sonar {

/// A ping fills up to the next, but no more than so many usual intervals.
inline constexpr double kGapIntervals = 3.0;

/// Where the pings of an observation lie along x, and how far one may reach.
struct Along {
  std::vector<double> x;  ///< [ping]
  double gap = 0.0;
};

struct StripSpan {
  double first = 0.0;
  double last = 0.0;
};

struct Strip {
  const TimelineObservation* observation;
  Along along;
  [[nodiscard]] StripSpan span() const {
    // The last ping takes its own room.
    return {along.x.front(), along.x.back() + along.gap / kGapIntervals};
  }
};

/// Bad pings, shaded and hatched.
void add_bad(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// Events: a line with a flag, and its text where there is room.
void add_marks(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme);
/// Observations named above the plot.
void add_names(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme);

}  // namespace sonar
