// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/product.h"
#include "view/key_rows.h"

namespace sonar {

/// What the lines and colours of an observation's map are. Schools have their numbers on the map; the key tells their
/// status.
[[nodiscard]] std::vector<KeyEntry> observation_map_key(const ObservationProduct& product, const Theme& theme);

}  // namespace sonar
