// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/app_model.h"

namespace sonar {

// What can be asked for by key or menu round slices; parts of add_slices().
void add_navigation_actions(AppModel& app);
void add_tool_actions(AppModel& app);
void add_display_actions(AppModel& app);

}  // namespace sonar
