// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/workspace.h"

namespace sonar {

/// The line below the window: what the cursor points at, what runs in the background, the last notice.
void add_status_line(QMainWindow& window, Workspace& workspace);

}  // namespace sonar
