// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/timelines/timeline.h"

namespace sonar {

/// One of two timelines that share a time axis.
struct TimelinePanel {
  TimelineObservation observation;
  TimelineStyle style;
};

/// Where two stacked timelines draw what.
struct StackedPlots {
  TimelinePlot above;
  TimelinePlot below;  ///< in the same picture
};

/// The height of the upper one of two, pixels.
[[nodiscard]] int upper_height(PixelSize size);

/// Two timelines one above the other, both over the part of time that the upper one shows. The lower one has no title: its
/// label says what it is.
/// errors  as timeline(); usage: along the log, which two sounders need not share
[[nodiscard]] Result<FrameDescription> stacked_timelines(const TimelinePanel& above, const TimelinePanel& below,
                                                         PixelSize size, const Theme& theme);
/// errors  as stacked_timelines()
[[nodiscard]] Result<StackedPlots> stacked_plots(const TimelinePanel& above, const TimelinePanel& below, PixelSize size,
                                                 const Theme& theme);

}  // namespace sonar
