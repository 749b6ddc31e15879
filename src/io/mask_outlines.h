// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "model/map_outlines.h"
#include "model/outline.h"
#include "model/product.h"

namespace sonar {

/// The outlines of the layers `swept` and `schools` of survey.gpkg, as plain data. Pings without position or heading are
/// left out; a school without such a ping, or without a mask, has an empty area.
/// product  with its masks
/// placed   how the pings lie
/// threads  pure
[[nodiscard]] ObservationOutlines map_outlines(const ObservationProduct& product,
                                               const PlacementOf& placed = &PingNavigation::placement);

/// Its parts alone, for whoever keeps those that stay the same.
[[nodiscard]] GeoArea swept_outline(const ObservationProduct& product,
                                    const PlacementOf& placed = &PingNavigation::placement);
[[nodiscard]] GeoArea school_outline(const ObservationProduct& product, std::int64_t school_id,
                                     const PlacementOf& placed = &PingNavigation::placement);

}  // namespace sonar
