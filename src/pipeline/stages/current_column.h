// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "model/current.h"
#include "model/navigation.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

/// The water's velocity at depths below the ship, from the recipe's profiles as schools' speeds through the water take it.
/// depths_m  below the sea surface, rising
/// result    depths of which no profile tells are left out; empty where the ship's position is unknown
[[nodiscard]] std::vector<CurrentAt> current_column(const Recipe& recipe, const PingNavigation& ship,
                                                    std::span<const double> depths_m);
/// What arrows of any of the profiles are scaled to (longest_arrow_mps()).
[[nodiscard]] double longest_arrow_mps(const CurrentProfiles& profiles);

}  // namespace sonar
