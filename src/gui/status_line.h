// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/app_model.h"

namespace sonar {

/// The line below the window: what the cursor points at, what runs in the background, the last notice, and an action that the
/// selected school waits for.
void add_status_line(QMainWindow& window, AppModel& app);

}  // namespace sonar
