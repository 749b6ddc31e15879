// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/desk.h"

namespace sonar {

/// Marks on the timeline: events, bad pings and intervals, and the way from one event to the next.
void add_timeline_actions(Desk& desk);

}  // namespace sonar
