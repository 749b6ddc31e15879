// SPDX-License-Identifier: Apache-2.0
#include "model/strongest_ping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {

const SchoolPingRow* strongest_ping(const ObservationProduct& product,
                                    const std::function<bool(const SchoolRow&)>& wanted) {
  const auto rank = [](const SchoolPingRow& row) {
    return std::pair(row.touches_edge == 0, std::isfinite(row.backscatter_m2) ? row.backscatter_m2 : 0.0);
  };
  const auto pings = static_cast<std::int64_t>(product.pings.size());
  const SchoolPingRow* strongest = nullptr;
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.ping_index < 0 || row.ping_index >= pings) continue;
    if (strongest != nullptr && rank(row) <= rank(*strongest)) continue;
    const auto school = std::ranges::find(product.schools, row.school_id, &SchoolRow::school_id);
    if (school != product.schools.end() && wanted(*school)) strongest = &row;
  }
  return strongest;
}

}  // namespace sonar
