// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "school/judge/track_echo.h"

namespace sonar {

/// Judge `surface`: bubbles hang from the sea surface and reach no deeper than the wind, a wake or a hull takes them. What
/// hangs there in most of its sightings, without water above it, and reaches no deeper may be either, unless it is too loud for bubbles: plumes in rows on
/// the sea, clouds that the hull carries, the surface's own reverberation.
/// out  the figure is the depth to which it reaches, median over its sightings
[[nodiscard]] std::optional<Reason> judge_surface(const TrackEcho& track);

}  // namespace sonar
