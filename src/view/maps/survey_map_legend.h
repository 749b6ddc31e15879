// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/depth_grid.h"
#include "view/maps/depth_layer.h"
#include "view/maps/map_frame.h"
#include "view/maps/scale_bars.h"
#include "view/maps/survey_map.h"
#include "view/school_look.h"

namespace sonar {

/// What the parts of a survey map draw with; borrows all of it.
struct SurveyMapDrawing {
  FrameDescription& frame;
  const MapFrame& map;
  const Theme& theme;
  const SchoolLook& look;
  double em;
  std::optional<ScaleBars> scale;  ///< in a corner that the ship and schools keep off where there is one
};

inline constexpr Rgba8 kSweptColour{110, 110, 110, 95};

/// What its colours mean; drawn with the legend, or left to the page.
[[nodiscard]] std::vector<ColourBar> survey_bars(const SurveyMapDrawing& d, const DepthBands& bands,
                                                 const SurveyMapStyle& style, bool schools);

/// Colour bars, symbols, circles and notes beside the map, as far as there is room for them.
/// schools  there are some
/// notes    more lines; empty ones are passed over
void add_survey_legend(const SurveyMapDrawing& d, const PixelRect& place, const DepthBands& bands,
                       const SurveyMapStyle& style, const DepthGrid* depths, bool schools,
                       const std::vector<std::string>& notes);

}  // namespace sonar
