// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/app_model.h"

namespace sonar {

/// A strip along the window's foot while a recording is followed: how it goes, and whether its newest ping is on show.
void add_live_strip(QMainWindow& window, AppModel& app);

}  // namespace sonar
