// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "school/track/open_track.h"

namespace sonar {

/// Two schools are two if they are ever seen apart. Tracks whose masks touch wherever both are seen are parts of one body
/// that a saddle in its echo divides (a waist, a hollow): they become one track, under the number of the first.
/// closed  all tracks; those that went into another are taken out
/// events  renamed, or dropped where they tell of parts of one school
void join_inseparable(std::vector<OpenTrack>& closed, std::vector<RawEvent>& events,
                      std::span<const DetectedPing> pings, const Sector& sector);

}  // namespace sonar
