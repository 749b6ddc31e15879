// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/school.h"
#include "school/measure/centre_track.h"

namespace sonar {

struct Tortuosity {
  double ratio = kUnknown;  ///< 1 = straight
  double se = kUnknown;
};

/// How winding a school's way is: length of the path over the distance from its beginning to its end. The noise of places
/// makes a path from place to place much too long, the more so the denser the pings: the path here is that of stretches of
/// one window each, of which each is a least-squares line, and what is left of the noise is taken off the length of each
/// stretch and of the whole, as off a speed (speed_of()). What winds within a window is not seen.
/// out     unknown with fewer than two windows, where one has fewer than three centres or all at one time, and where the
///         distance is less than two of its standard errors. The error is that of first order: it vanishes for a straight
///         path, of which path and distance err alike.
[[nodiscard]] Tortuosity tortuosity(const CentreTrack& track, double window_s);

}  // namespace sonar
