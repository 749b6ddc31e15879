// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "session/desk.h"
#include "session/survey_schools.h"

// A school that was carried as far as the panel's reach, and goes on: it is said at once, and one action carries it on.
namespace sonar {

inline constexpr std::string_view kContinueAction = "school.continue";

/// "school 3 goes on beyond 30 pings: continue?"; empty where it does not.
/// line  the propagation that made it, or carried it on, last
[[nodiscard]] std::string beyond_reach_text(const StateSchool& school, const PropagateCommand& command);

/// The school that a propagation made or carried on; null where it is gone.
/// n  of its line
[[nodiscard]] const StateSchool* school_followed(const JournalState& state, const CommandGround& ground, std::int64_t n,
                                                 const PropagateCommand& command);

/// Carries the selected school on from each end at which its propagation had its reach, as far again as the panel says; one
/// step to undo.
void continue_beyond_reach(Workspace& workspace);

/// Adds school.continue, which is enabled while the selected school has such an end.
void add_continuing(Desk& desk);

}  // namespace sonar
