// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/sector.h"
#include "model/mask.h"
#include "school/track/motion.h"

namespace sonar {

/// A place of a mask as another ping would see it.
struct MovedPoint {
  SectorIndex index;
  double volume_m3 = 0.0;  ///< of the water it stands for
};

/// The voxels of a mask, thinned along range, carried over ground and looked at from another ping.
/// shift       the school's own movement, m
/// every       samples that one point stands for, >= 1
/// out         points inside the sector only
[[nodiscard]] std::vector<MovedPoint> moved_mask(const PingMask& mask, const Sector& sector, const PingFrame& from,
                                                 const PingFrame& to, const Point<Enu>& shift, int every);

}  // namespace sonar
