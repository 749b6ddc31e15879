// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/app_model.h"

namespace sonar {

/// Lets a human calibrate by a sphere run, look at the beams, write the table and use it.
void show_sphere_page(QWidget& window, AppModel& app, SpherePage& page);

/// Shows the setup check of the open survey, and lets a human take what it proposes into the recipe.
void show_setup_page(QWidget& window, AppModel& app, SetupPage& page);

}  // namespace sonar
