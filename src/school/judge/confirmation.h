// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "school/judge/judge_params.h"
#include "school/judge/track_echo.h"

namespace sonar {

/// Unit of the evidence of a track's sightings together.
inline constexpr std::string_view kAllSightings = "evidence over all pings";

/// Judge `confirmation`: a school is seen in pings near each other, and what its sightings show together is more than chance
/// gives. Faint sightings count for little and many of them for much; a ping that shows none counts against it.
/// out  the figure is the most sightings in a window, or the evidence of all
[[nodiscard]] std::optional<Reason> judge_confirmation(const TrackEcho& track, const ConfirmationParams& params);

}  // namespace sonar
