// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "model/product.h"
#include "pipeline/merge_params.h"

namespace sonar {

/// A school's first row of school_pings, or its last; null where it has none.
[[nodiscard]] const SchoolPingRow* end_row(const ObservationProduct& product, std::int64_t school_id, bool last);

/// Distance between where the earlier track would be by then and where the later one begins, m; negative = outside the gate.
/// school, end   the earlier one, and its last ping
/// next, begin   the later one, and its first ping
[[nodiscard]] double miss(const SchoolRow& school, const SchoolPingRow& end, const SchoolRow& next,
                          const SchoolPingRow& begin, const MergeParams& params);

}  // namespace sonar
