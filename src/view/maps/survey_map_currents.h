// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "model/current.h"
#include "view/maps/survey_map_legend.h"

namespace sonar {

/// Arrows of the water's velocity at the places of profiles, as many as there is room for: at up to three depths (a tenth,
/// half and nine tenths of those that are told, round in the unit of lengths), each in a colour, those of longest_arrow_mps() 3 em
/// long. Faster water has an arrow of that length with two heads. A place of which the border would cut one of that length has none. The
/// depths stand at arrows half way.
/// profiles  those without a place are left out
/// out       what the arrows mean, for the legend; empty where none is drawn
[[nodiscard]] std::string add_currents(const SurveyMapDrawing& d, const CurrentProfiles& profiles);

}  // namespace sonar
