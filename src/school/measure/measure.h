// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/mask.h"
#include "model/school.h"
#include "school/measure/body_echo.h"
#include "school/measure/measure_input.h"
#include "school/measure/measure_params.h"

namespace sonar {

/// Which members are faulty samples and take no part in Sv, in the mask's order.
[[nodiscard]] std::vector<bool> faulty_members(const MeasureInput& ping, const PingMask& mask);

/// The row alone, without backscatter_total and what correct_sizes() needs.
[[nodiscard]] SchoolPingRow measure_row(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

/// A school in one ping.
struct MeasuredSchool {
  SchoolPingRow row;  ///< of school_pings.csv; the corrected columns wait for correct_sizes()
  BodyEcho body;
};

/// Measures a school in one ping; observation, school_id, ping_index, time and provisional are left to the caller.
/// mask     not empty; one without a voxel of known volume gives a row of unknowns
/// threads  pure; fixed order of sums
/// cost     linear in the mask's voxels and their surroundings
[[nodiscard]] MeasuredSchool measure(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
