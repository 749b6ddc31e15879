// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "school/judge/judge_params.h"
#include "school/judge/track_echo.h"

namespace sonar {

/// Judge `ship`: what was tracked goes where the ship goes. What keeps its place in the sonar frame while the ship makes way,
/// more closely than a school would by chance, is what the sonar hears of the seabed, the surface or itself there, through
/// side lobes as well. Of what the sector's sides cut only a part is seen: its place tells something only after a way
/// longer than schools are.
/// out  the figure is its drift beside the ship as a share of the ship's way
[[nodiscard]] std::optional<Reason> judge_ship(const TrackEcho& track, const ShipParams& params);

}  // namespace sonar
