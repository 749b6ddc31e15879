// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "model/product.h"
#include "view/axes.h"
#include "view/echograms/echogram_schools.h"
#include "view/frame_description.h"
#include "view/sv_scale.h"
#include "view/theme.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

enum class EchogramValue : std::uint8_t { mean, maximum, minimum };
inline constexpr std::array<std::string_view, 3> kEchogramValueNames{"mean", "maximum", "minimum"};
enum class TimelineAxis : std::uint8_t { time, log };
inline constexpr std::array<std::string_view, 2> kTimelineAxisNames{"time", "log"};

struct TimelineInterval {
  TimeNs first = 0;
  TimeNs last = 0;
  friend bool operator==(const TimelineInterval&, const TimelineInterval&) = default;
};

/// Part of an upright axis, m; first = top.
struct TimelineHeights {
  double first_m = 0.0;
  double last_m = 0.0;
  friend bool operator==(const TimelineHeights&, const TimelineHeights&) = default;
};
/// All of an echogram's bins, but what lies above the surface.
[[nodiscard]] TimelineHeights heights_of(const EchogramRange& range);

struct TimelineStyle {
  EchogramValue value = EchogramValue::mean;  ///< over beams (and pings and ranges, where a pixel has several)
  TimelineAxis axis = TimelineAxis::time;
  SvScale scale{.low_db = kMeansLow_db};
  bool schools = true;
  bool by_school = false;  ///< each school in its own colour, rejected ones grey; else status tells the colour
  bool brief = false;      ///< no title, and a colour bar only where it is wide: a window has its own
  bool raw_there = false;  ///< the raw data are there: an echogram that is missing is being read
  bool filtered = false;   ///< echograms are of data without noise, and the title says so
  bool searched = true;    ///< schools were looked for; else the title says that they were not
  std::optional<TimelineInterval> shown = {};  ///< part of the time axis; empty = all of it
  // Of an echogram of one beam, fan or channel.
  std::string of = {};    ///< what it is of, below the title; empty = all beams
  bool outlined = false;  ///< schools are the edges of what is in them here, not tracks
  EchogramHeight height = EchogramHeight::range;
  std::optional<TimelineHeights> shown_heights = {};  ///< part of the upright axis; empty = all of it
  friend bool operator==(const TimelineStyle&, const TimelineStyle&) = default;
};

template <class Visitor>
void describe(Visitor& v, TimelineStyle& p) {
  v.choice("value", p.value, kEchogramValueNames, "what of all beams is shown");
  v.choice("axis", p.axis, kTimelineAxisNames, "along time or the vessel's log");
  v.group("scale", p.scale, "colours of Sv");
  v.field("schools", p.schools, {.text = "draw school tracks in"});
  v.field("by_school", p.by_school, {.text = "each school in a colour of its own; off = status tells the colour"});
  v.field("raw_there", p.raw_there, {.text = "a missing echogram is being read, not gone"});
  v.field("filtered", p.filtered, {.text = "the echograms are of data whose noise was removed"});
  v.field("searched", p.searched, {.text = "schools were looked for"});
  v.field("brief", p.brief, {.text = "no title; a colour bar only where it is wide"});
  v.field("outlined", p.outlined, {.text = "outline schools where they are in what is shown; off = draw their tracks"});
  v.choice("height", p.height, kEchogramHeightNames, "along range, or depth below the sea surface");
}

/// What a human marked, on the clock of the product's pings.
struct TimelineMark {
  TimeNs time = 0;
  std::string kind;  ///< "trawl", ...
  std::string text;
};
/// A point of a line that was drawn over time, on the clock of the product's pings.
struct TimelinePoint {
  TimeNs time = 0;
  double height_m = 0.0;  ///< on the upright axis; NaN = unknown, and the line has a gap there
};
/// One observation of a timeline.
struct TimelineObservation {
  const ObservationProduct* product = nullptr;
  const EchogramPyramid* echogram = nullptr;  ///< nullptr: no raw data, schools only
  std::vector<TimelineMark> marks = {};
  std::vector<TimelineInterval> bad = {};        ///< pings that take no part in measures
  std::optional<std::int64_t> selected = {};     ///< school_id that is highlighted
  std::span<const RefusedEcho> refused = {};     ///< marked, each echo where it was loudest
  std::int64_t chosen_echo = 0;                  ///< echo_id that is highlighted; 0 = none
  std::span<const EchogramSchool> schools = {};  ///< where the style outlines them
  std::span<const EchogramStretch> shadow = {};  ///< of schools, hatched; by ping
  std::string label = {};                        ///< named above it so; empty = the observation's name
  std::span<const TimelinePoint> line = {};      ///< in time order; drawn from ping to ping
  std::string line_name = {};                    ///< of its file, for the key
};

/// A raster of an echogram, and what it cost.
struct EchogramImage {
  Image image;
  int finest_level = 0;          ///< of the levels that were read
  std::uint64_t cells_read = 0;  ///< grows with the picture, not with the number of pings
};
/// x       [ping] places of the pings on the plot's x axis, not falling
/// gap     longest step of x that a ping fills up to the next one; before a longer one it fills a third of it
[[nodiscard]] EchogramImage echogram_image(const EchogramPyramid& echogram, std::span<const double> x, double gap,
                                           const PlotFrame& plot, EchogramValue value, const SvColours& colours);

/// Range against time (or log) for an observation or a whole survey: Sv of all beams, school tracks with their numbers
/// in the line style of their status, observations named above, gaps left empty, pings without data grey and hatched; a
/// key below says what is not plain. Also the echogram of one beam, fan or channel, against range or depth, with its
/// schools outlined.
/// observations  in time order
/// errors        bad_parameter: a parameter out of range, or too small a picture; not_found: no pings; usage: no log
[[nodiscard]] Result<FrameDescription> timeline(std::span<const TimelineObservation> observations,
                                                const TimelineStyle& style, PixelSize size, const Theme& theme);

/// Where on the picture timeline() draws which time: x is seconds since `zero` (or the log), y is range.
struct TimelinePlot {
  PlotFrame plot;
  TimeNs zero = 0;
  TimelineInterval all;  ///< what the time axis shows where nothing is said of a part
};
/// errors  as timeline()
[[nodiscard]] Result<TimelinePlot> timeline_plot(std::span<const TimelineObservation> observations,
                                                 const TimelineStyle& style, PixelSize size, const Theme& theme);

/// Ticks at round times: seconds to weeks. At most `most`.
struct TimeTick {
  TimeNs time = 0;
  std::string text;  ///< "08:05", with seconds where the step needs them; the date at midnight where steps are days
};
[[nodiscard]] std::vector<TimeTick> time_ticks(TimeNs first, TimeNs last, int most);

}  // namespace sonar
