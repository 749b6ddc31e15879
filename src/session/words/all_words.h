// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "session/app_model.h"

namespace sonar {

/// The texts that the models hand to a window, in English: what actions, menus, docks, columns and parameters are called, and
/// what is told of each. Whoever translates the program translates these, and the window's own. What is made as it happens
/// ("Undo: school 3 accepted") is not among them.
[[nodiscard]] std::set<std::string> all_words(AppModel& app);

}  // namespace sonar
