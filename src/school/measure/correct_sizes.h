// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/school.h"
#include "school/measure/measure.h"
#include "school/measure/measure_params.h"

namespace sonar {

/// One school's pings, rising by ping_index; borrowed.
using SchoolThroughPings = std::vector<const MeasuredSchool*>;

/// Rows of an observation's schools with their corrected columns filled, beam and pulse taken out. A body low beside the
/// beam hardly shows its height in one ping: pings near in time are taken together, each with its own range and fans.
/// The shape of the beam is taken from all of them.
/// out  one school after the other, each in the order of its pings
[[nodiscard]] std::vector<SchoolPingRow> correct_sizes(const std::vector<SchoolThroughPings>& schools,
                                                       const MeasureParams& params);

}  // namespace sonar
