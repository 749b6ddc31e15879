// SPDX-License-Identifier: Apache-2.0
#include "pipeline/commands/recipe_propagation.h"

namespace sonar {

PropagateCommand recipe_propagation(const Recipe& recipe, std::optional<GrowMode> mode) {
  PropagateCommand command;
  command.mode = mode.value_or(recipe.grow.mode);
  command.grow = recipe.grow;
  command.grow.mode = command.mode;
  command.paper = recipe.propagate_paper;
  command.tracked = recipe.propagate_tracked;
  command.growth_curve = recipe.growth_curve;
  return command;
}

Result<PropagateCommand> completed(PropagateCommand command) {
  if (command.grow.connectivity == Connectivity::all) {
    command.paper.connectivity = command.tracked.connectivity = Connectivity::all;
  }
  for (const auto& valid : {validate(command.grow), validate(command.tracked), validate(command.paper)}) {
    if (!valid) return pass_on(valid);
  }
  return command;
}

}  // namespace sonar
