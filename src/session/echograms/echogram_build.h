// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "session/looks/picture_look.h"
#include "session/open/document.h"
#include "session/timelines/echograms.h"
#include "session/timelines/timeline_model.h"
#include "view/frame_description.h"

namespace sonar {

/// An echogram as far as it is filled, and what it is of.
struct EchogramSoFar {
  EchogramName name;
  EchogramPtr echogram;  ///< null = nothing yet
};

/// Everything that the window's echogram shows, as it was when the picture was asked for.
struct EchogramWish {
  std::shared_ptr<const SurveyFiles> survey;
  EchogramSoFar of;
  std::optional<EchogramSoFar> below;  ///< a channel of another sounder that ran at the same time
  OpenObservationPtr open;             ///< null where the observation has no grid: nothing is measured or marked in it
  ProductPtr product;                  ///< null where nothing is measured
  JournalStatePtr state;               ///< null where nothing is marked
  std::optional<std::int64_t> selected;
  RefusedPtr refused;                   ///< that are marked; null = none
  std::vector<EchogramStretch> shadow;  ///< of schools, as far as it is known
  std::int64_t chosen_echo = 0;
  std::optional<TimelineInterval> shown;  ///< part of the time axis; empty = all
  std::optional<TimelineHeights> heights;
  DisplayParams display;
  PictureLook look;
};

/// Where one of the plots shows what.
struct EchogramPlot {
  TimelinePlaces places;
  EchogramSoFar of;
};
struct EchogramPlaces {
  EchogramPlot above;
  std::optional<EchogramPlot> below;
  TimelineHeights heights;  ///< all of the upper one's
};

struct BuiltEchogram {
  FrameDescription frame;
  std::shared_ptr<const EchogramPlaces> places;
};
/// errors  as timeline()
[[nodiscard]] Result<BuiltEchogram> built_echogram(const EchogramWish& wish, PixelSize size);

/// "beam 12 of fan 7: ...", "channel 2 of 3: 38 kHz".
/// open  of the observation; may be null for a channel
[[nodiscard]] std::string echogram_text(const SurveyFiles& survey, const EchogramName& name,
                                        const OpenObservationPtr& open);

}  // namespace sonar
