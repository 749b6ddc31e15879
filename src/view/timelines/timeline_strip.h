// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "view/key_rows.h"
#include "view/timelines/timeline.h"

namespace sonar {

/// A ping fills up to the next one; where that lies more than so many usual intervals away there is a gap.
inline constexpr double kGapIntervals = 3.0;

/// Where the pings of an observation lie along x, and how far one may reach.
struct Along {
  std::vector<double> x;  ///< [ping]
  double gap = 0.0;
  /// Whether there is a gap between two pings.
  [[nodiscard]] bool gap_between(std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i < to; ++i) {
      if (x[i + 1] - x[i] > gap) return true;
    }
    return false;
  }
};

/// Where what is shown of a ping ends: at the next one, or before a gap after a usual interval.
[[nodiscard]] inline double filled_until(std::span<const double> x, double gap, std::size_t ping) {
  const bool on = ping + 1 < x.size() && x[ping + 1] - x[ping] <= gap;
  return on ? x[ping + 1] : x[ping] + gap / kGapIntervals;
}

struct StripSpan {
  double first = 0.0;
  double last = 0.0;
};

struct Strip {
  const TimelineObservation* observation = nullptr;
  Along along;
  [[nodiscard]] StripSpan span() const {
    // The last ping takes its own room.
    return {along.x.front(), along.x.back() + along.gap / kGapIntervals};
  }
};

/// Ticks and label below a plot whose x is seconds since `zero`, or the log.
void add_x_axis(FrameDescription& frame, const PlotFrame& plot, TimelineAxis axis, TimeNs zero, const Theme& theme);
/// Bad pings, shaded and hatched.
void add_bad(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// Stripes over a rectangle, rising (slope -1) or falling (1) to the right.
[[nodiscard]] PathItem hatch_item(const PixelRect& place, double slope, const Theme& theme);
/// Pings whose columns hold no data at all: neither a gap nor quiet water.
[[nodiscard]] bool any_silent(const Strip& strip);
void add_silent(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// A school's number on a timeline, and the track that it names.
struct TrackNumber {
  std::string text;
  bool selected = false;
  std::vector<PixelPoint> seen;  ///< the track as far as it is shown; at least one place
};
/// School tracks.
/// numbers  of those that are seen, added to: they stand over all tracks, or the next one would hide them
void add_tracks(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const TimelineStyle& style,
                const Theme& theme, std::vector<TrackNumber>& numbers);
/// Schools as the edges of the cells that they have in an echogram.
/// numbers  as add_tracks()
void add_outlines(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const TimelineStyle& style,
                  const Theme& theme, std::vector<TrackNumber>& numbers);
/// Stripes where schools cast shadow on an echogram, as slices have them.
void add_shadow(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// Numbers at their tracks' first pings, else at other places along them, none on another; those that find no room are
/// left out, but for the selected school's.
void add_track_numbers(FrameDescription& frame, std::span<const TrackNumber> numbers, const PlotFrame& plot,
                       const Theme& theme);
/// A school's colour on a timeline: its own, or that of its status.
[[nodiscard]] Rgba8 timeline_colour(std::int64_t school_id, const std::string& status, const TimelineStyle& style,
                                    const Theme& theme);
void add_refused(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// What the lines and the shades of a timeline are.
[[nodiscard]] std::vector<KeyEntry> timeline_key(std::span<const Strip> strips, const TimelineStyle& style,
                                                 const Theme& theme);
/// The line of an observation.
void add_line(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme);
/// Events: a line with a flag, and its text where there is room.
void add_marks(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme);
/// Observations named above the plot.
void add_names(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme);

}  // namespace sonar
