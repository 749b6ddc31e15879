// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/actions.h"
#include "session/recipes/recipe_editor.h"

namespace sonar {

/// Lets a human change a recipe: what every user sets, and the experts' parameters folded below, with a search.
/// dialogs  ask for the files it is loaded from and saved to
/// out      false where the human declined
[[nodiscard]] bool change_recipe(QWidget& window, const Dialogs& dialogs, RecipeEditor& editor);

}  // namespace sonar
