// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/desk.h"

namespace sonar {

// What can be asked for by key or menu round slices; parts of add_slices().
void add_navigation_actions(Desk& desk);
void add_tool_actions(Desk& desk);
void add_display_actions(Desk& desk);

}  // namespace sonar
