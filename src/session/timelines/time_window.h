// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/axes.h"
#include "view/pointer_event.h"
#include "view/timelines/timeline.h"

namespace sonar {

/// Where a timeline shows which time; x is seconds since `zero`.
struct TimelinePlaces {
  PlotFrame plot;
  TimeNs zero = 0;
  TimelineInterval all;  ///< what the whole time axis shows
  [[nodiscard]] double x_of(TimeNs time) const;
  [[nodiscard]] TimeNs time_at(double x_px) const;
};

/// The part of a time axis that is shown: the wheel and a pinch zoom about the pointer, dragging with the middle button and
/// two fingers pan, a double press shows everything.
class TimeWindow {
 public:
  /// Empty = all.
  [[nodiscard]] const std::optional<TimelineInterval>& shown() const { return shown_; }
  /// out  whether something else is shown from now on; empty = the event is not for it
  std::optional<bool> take(const PointerEvent& event, const TimelinePlaces& places);
  // Each tells whether something else is shown from now on.
  bool show_all();
  /// A time that lies outside comes into the middle.
  bool follow(TimeNs time, const TimelinePlaces& places);

 private:
  bool zoom(double x_px, double factor, const TimelinePlaces& places);
  bool pan_to(double x_px, const TimelinePlaces& places);
  bool show_part(TimeNs first, TimeNs length, const TimelineInterval& all);

  struct Pan {
    double x = 0.0;
    TimelineInterval part;
  };
  std::optional<Pan> pan_;
  std::optional<TimelineInterval> shown_;
};

}  // namespace sonar
