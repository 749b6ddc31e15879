// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "school/judge/confirmation.h"
#include "school/judge/level.h"
#include "school/judge/ship.h"
#include "school/judge/surface.h"

namespace sonar {

/// The judges of tracks, in the order in which they are asked: the first reason is the one that is told.
inline constexpr std::array<TrackJudge, 4> kTrackJudges{{
    {"confirmation", judge_confirmation},
    {"ship", judge_ship},
    {"level", judge_level},
    {"surface", judge_surface},
}};

}  // namespace sonar
