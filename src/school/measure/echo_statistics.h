// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/echo_statistics.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/mask_shape.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// Whether a sample is kept in a mask and takes no part in Sv.
[[nodiscard]] bool is_faulty(SampleFlags flags, std::int16_t count);

/// each_run  told, for each run with a heard member, its row and the echo of those members, m^2; may be empty
/// uses      sv, flags, sector and background of the input
/// threads   pure; sums in the mask's order
/// cost      linear in the mask's voxels
[[nodiscard]] EchoStatistics echo_statistics(const MeasureInput& ping, const PingMask& mask,
                                             const std::function<void(int row, double echo_m2)>& each_run = {});

/// mask        not empty
/// covariance  of its members, sonar frame (MaskShape)
[[nodiscard]] MaskExtents mask_extents(const PingMask& mask, const Covariance3& covariance, const Sector& sector,
                                       const Placement& placement);

}  // namespace sonar
