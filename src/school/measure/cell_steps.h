// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/mask.h"
#include "model/school.h"
#include "model/school_errors.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// By how much a figure that is read from the ends of a mask moves if an end moves by a cell, in the order of kErrorColumns: the
/// length along it of the cell's edges, taken as vectors, where the school's centre is. 0 = moves by less than cells, or unknown.
/// row  of this mask
[[nodiscard]] FigureValues cell_steps(const MeasureInput& ping, const PingMask& mask, const SchoolPingRow& row);

}  // namespace sonar
