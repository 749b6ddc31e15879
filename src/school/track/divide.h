// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "geo/sector.h"
#include "model/mask.h"
#include "school/mask_shape.h"
#include "school/track/motion.h"

namespace sonar {

/// Where a school should be, and its shape when it was last seen alone; east, north, up.
struct ExpectedBody {
  Point<Enu> centre;         ///< m
  Covariance3 covariance{};  ///< of its members, m^2
};

/// Shares a mask among schools that have met in it: each voxel goes to the school in which it would lie deepest, by its
/// distance from the centre in units of that school's extent.
/// least_m  added to each extent: a school that was seen in one sample is no plane
/// out      one mask for each body, some may be empty; together they are the mask, and no voxel is in two
[[nodiscard]] std::vector<PingMask> divide(const PingMask& mask, const Sector& sector, const PingFrame& frame,
                                           std::span<const ExpectedBody> bodies, double least_m);

}  // namespace sonar
