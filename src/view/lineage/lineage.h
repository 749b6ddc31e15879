// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "model/track_edge.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/theme.h"
#include "view/timelines/timeline.h"

namespace sonar {

/// A school of a lineage.
struct LineageSchool {
  std::int64_t school_id = 0;
  std::string status = "unreviewed";
  std::vector<std::int64_t> pings;  ///< in which it is seen, rising; one at least
};

/// The schools of an observation as a graph.
struct LineageData {
  std::string title;
  std::vector<TimeNs> times;  ///< [ping_index], rising
  std::vector<LineageSchool> schools;
  std::vector<TrackEdge> edges;  ///< of these schools
  std::optional<std::int64_t> selected = {};
};

struct LineageStyle {
  bool brief = false;                          ///< no title and no key: a window has its own
  std::optional<TimelineInterval> shown = {};  ///< part of the time axis; empty = all of it
  bool free_lane = false;                      ///< one lane more below: room for a school that is to come
};

/// A lineage, and where it shows what: x is seconds since `zero`, y counts lanes from the top.
struct Lineage {
  FrameDescription frame;
  PlotFrame plot;
  TimeNs zero = 0;
  TimelineInterval all;             ///< what the time axis shows where nothing is said of a part
  std::vector<std::int64_t> lanes;  ///< [lane from the top] school_id
};

/// Schools in the order of their lanes: by their first pings, and each that came out of another or went into one next to
/// that one.
[[nodiscard]] std::vector<std::int64_t> lane_order(const LineageData& data);

/// Schools over time, a lane each: a bar while it is seen, a thin line while it is lost, upright lines where it came out of
/// another school or went into one, a dot where it was born and a stroke where it was lost. The selected one is framed.
/// Schools that are not there in the part of time that is shown have no lane in it.
/// errors  bad_parameter: too small a picture; not_found: no pings, or no schools
[[nodiscard]] Result<Lineage> lineage(const LineageData& data, const LineageStyle& style, PixelSize size,
                                      const Theme& theme);

}  // namespace sonar
