// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/app_model.h"

namespace sonar {

/// Marks on the timeline: events, bad pings and intervals, and the way from one event to the next.
void add_timeline_actions(AppModel& app);
/// Takes the chosen mark away: a mark, or that the pings of an interval are bad. One act that can be undone.
void remove_mark(Workspace& workspace);
/// "Remove mark trawl"; empty where none is chosen.
[[nodiscard]] std::string mark_text(const Workspace& workspace);

}  // namespace sonar
