// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/app_model.h"
#include "session/echograms/echogram_model.h"

namespace sonar {

/// What the window's echogram is of, and along what. The model belongs to a dock of the app.
void add_echogram_actions(AppModel& app, EchogramModel& echogram);

}  // namespace sonar
