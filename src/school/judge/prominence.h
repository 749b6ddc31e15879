// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "school/detect/detection.h"
#include "school/judge/ping_echo.h"

namespace sonar {

/// How far a school stands above the level at which it hangs together with nothing else, at least.
inline constexpr double kLeastProminence_db = 6.0;

/// Judge `prominence`: what rises above a stronger neighbour's skirt, or the water beside it, by no more than fading does
/// is a part of that. The figure is its reference above its threshold, the level at which it was found.
[[nodiscard]] std::optional<Reason> judge_prominence(const PingEcho& echo, const Detection& detection);

}  // namespace sonar
