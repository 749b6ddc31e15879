// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "session/app_model.h"

// A school that was carried by hand as far as the panel's reach, and goes on: one action follows it on from there.
namespace sonar {

inline constexpr std::string_view kContinueAction = "school.continue";

/// Carries the selected school on from each end at which its propagation had its reach, as far again as the panel says; one
/// step to undo.
void continue_beyond_reach(Workspace& workspace);

/// Adds school.continue, which is enabled while the selected school has such an end and no other part of it is known beyond.
void add_continuing(AppModel& app);

}  // namespace sonar
