// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "session/looks/picture_look.h"
#include "session/open/document.h"
#include "session/timelines/timeline_model.h"

namespace sonar {

/// Everything that a timeline shows, as it was when the picture was asked for.
struct TimelineWish {
  struct Observation {
    std::size_t index = 0;
    ProductPtr product;  ///< null where nothing is measured
    JournalStatePtr state;
    OpenObservationPtr open;  ///< null where it is not: it has no state either
    EchogramPtr echogram;
    std::optional<std::int64_t> selected;
    RefusedPtr refused;  ///< that are marked; never null
    std::int64_t chosen_echo = 0;
  };
  std::shared_ptr<const SurveyFiles> survey;
  std::vector<Observation> observations;
  std::optional<TimelineInterval> shown;  ///< part of the time axis; empty = all
  std::vector<Transect> transects;        ///< flags tell where each begins
  bool maximum = true;                    ///< of all beams, else their mean
  bool filtered = false;                  ///< the echograms are without noise
  SvScale sv;
  bool rejected = true;
  PictureLook look;
};

/// Draws timelines one after another.
/// threads  one at a time
class TimelinePainter {
 public:
  struct Painted {
    FrameDescription frame;
    std::shared_ptr<const TimelinePlaces> places;
  };
  /// errors  as timeline()
  [[nodiscard]] Result<Painted> paint(const TimelineWish& wish, PixelSize size);

 private:
  std::shared_ptr<const SurveyFiles> survey_;
  std::map<std::size_t, ObservationProduct> heads_;
};

/// Adds what a human marked: events, and pings that take no part in measures.
void add_marked(TimelineObservation& drawn, const JournalState& state, const OpenObservation& observation);

/// A time of the datagrams' clock on the clock of the pings that pictures show.
[[nodiscard]] TimeNs shown_time(const OpenObservation& observation, TimeNs datagram_time);

/// Where on that clock the shade of bad pings ends: at the next one.
[[nodiscard]] TimeNs bad_until(const OpenObservation& observation, const BadPingsCommand& bad);

}  // namespace sonar
