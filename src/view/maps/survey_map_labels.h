// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "view/maps/survey_map_legend.h"

namespace sonar {

/// Where an observation begins on the map; empty where it has no position.
[[nodiscard]] std::optional<PixelPoint> start_on_map(const SurveyMapDrawing& d, const ObservationProduct& product);

/// Observations' names as they go on a map.
struct StartNames {
  std::vector<TextItem> names;
  decltype(FrameDescription::items) leaders;  ///< lines to the starts of those that found no room beside them
  std::vector<std::string> left_out;
};
/// Names beside their starts, away from where the ship went where there is a choice: none on another, on a school's
/// circle, on a start, on the ship or over the map's edge. One that finds room only farther off has a line to its start.
/// ship  where it is drawn; empty = nowhere
[[nodiscard]] StartNames start_names(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                                     const std::optional<PixelPoint>& ship);

/// Schools' numbers, and names where they were given some: they keep off the observations' names and starts, the ship
/// and the scale.
/// returns  what found no room
[[nodiscard]] std::vector<std::string> add_numbers(const SurveyMapDrawing& d,
                                                   std::span<const ObservationProduct> observations,
                                                   std::span<const TextItem> names,
                                                   const std::optional<PixelPoint>& ship);

}  // namespace sonar
