// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geo/frames.h"
#include "io/nav_series.h"

namespace sonar {

/// The sentences of one quantity that were chosen, in time order, one per instant.
struct NavTrack {
  std::string talker;  ///< empty where nobody said anything
  std::string sentence;
  std::vector<NavSample> samples;
};

/// Chooses one talker (the one wanted, else the most frequent; equally frequent ones alphabetically) and one of its
/// kinds of sentence.
[[nodiscard]] NavTrack choose_track(std::span<const NavSeries* const> series, NavQuantity quantity,
                                    std::string_view wanted_talker);

/// Takes fixes out of a track of positions that jump away and back: a stretch that is reached from the fix before it, and
/// from which the fix after it is reached, only by going faster than max_speed_mps, while that fix is reached from the one
/// before. The stretch has fewer fixes than its two neighbours together, and lasts no longer than `longest` between them
/// unless it is a single fix. A ship that goes on elsewhere does not come back, and keeps its fixes.
/// out  what was taken out, in time order
[[nodiscard]] std::vector<NavSample> drop_jumps(NavTrack& track, double max_speed_mps, TimeNs longest);

/// Position at an instant: along the geodesic between the fixes round it; no farther than `limit` from a fix it goes on
/// at the speed of the last fixes. NaN where there is none.
[[nodiscard]] Geographic position_at(const NavTrack& track, TimeNs time, TimeNs limit);
/// Linear; beyond the ends, and in gaps longer than twice the limit, the nearest value holds for `limit`. Else NaN.
[[nodiscard]] double value_at(const NavTrack& track, TimeNs time, TimeNs limit);

enum class AngleOf { first, second };
/// The same for angles in degrees, over the shorter arc, [0, 360).
[[nodiscard]] double angle_at(const NavTrack& track, TimeNs time, TimeNs limit, AngleOf which);

}  // namespace sonar
