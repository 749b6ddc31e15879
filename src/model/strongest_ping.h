// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "model/product.h"

namespace sonar {

/// The row of the largest backscatter among schools in pings where no edge cuts them, else among all; null where there is
/// none.
/// wanted  which schools count
[[nodiscard]] const SchoolPingRow* strongest_ping(const ObservationProduct& product,
                                                  const std::function<bool(const SchoolRow&)>& wanted);

}  // namespace sonar
