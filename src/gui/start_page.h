// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/app_model.h"

namespace sonar {

/// Lies over the docks until a survey is open: what to open, what was open last, and the three steps from there to tables.
/// The window's actions are there.
void add_start_page(QMainWindow& window, AppModel& app);

}  // namespace sonar
