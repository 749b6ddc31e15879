// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/product.h"
#include "view/maps/survey_map.h"
#include "view/maps/survey_map_legend.h"

namespace sonar {

/// A broad line along the track of each transect in the colour of its stratum, over it in grey what is told to be off
/// effort.
void add_transects(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                   const SurveyMapStyle& style);

/// Beside the middle of what is seen of each transect.
[[nodiscard]] std::vector<TextItem> transect_names(const SurveyMapDrawing& d,
                                                   std::span<const ObservationProduct> observations,
                                                   const SurveyMapStyle& style);

/// What these lines mean, for the legend; empty where there are none.
[[nodiscard]] std::string transects_text(const SurveyMapStyle& style);

}  // namespace sonar
