// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/app_model.h"

namespace sonar {

/// Lets a human change the preferences, which follow at once.
/// out  false where the human declined: what was there is to be brought back
[[nodiscard]] bool ask_preferences(QWidget& window, AppModel& app);

/// Size of text in the window's menus, lists and controls: 9 points at least.
/// percent  of the usual one
void take_text_size(double percent);

}  // namespace sonar
