// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/app_model.h"

namespace sonar {

/// A bar with what is done most, out of the menus' actions; those that are not there are left out. What
/// cannot act now is greyed.
void add_tool_bar(QMainWindow& window, AppModel& app);

/// Draws the bar's icons in the palette's colour of text: those that are black are lost on dark.
void tint_tool_bar(QMainWindow& window);

}  // namespace sonar
