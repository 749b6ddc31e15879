// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/result.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

/// A selection and propagation as a recipe sets it: no seeds, as far as it goes.
/// mode  empty = the recipe's
[[nodiscard]] PropagateCommand recipe_propagation(const Recipe& recipe, std::optional<GrowMode> mode);

/// What is selected with all 26 neighbours is followed with them; and whether all parameters are in their ranges.
/// errors  bad_parameter
[[nodiscard]] Result<PropagateCommand> completed(PropagateCommand command);

}  // namespace sonar
