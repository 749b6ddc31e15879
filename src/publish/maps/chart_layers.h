// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "base/result.h"
#include "geo/map_projection.h"
#include "model/current.h"
#include "model/depth_grid.h"
#include "model/map_outlines.h"
#include "model/product.h"

namespace sonar {

/// Outlines of a product's schools, where only what changed is worked out.
/// before   the product that `kept` was made from; null = none
/// kept     outlines; what it has swept is handed on
[[nodiscard]] ObservationOutlines school_outlines(const ObservationProduct& product, const ObservationProduct* before,
                                                  const ObservationOutlines& kept);
/// What the observation swept. cost: rises with its pings
[[nodiscard]] GeoArea swept_area(const ObservationProduct& product);

/// Water velocities that stand in a product's recipe; null where there are none.
[[nodiscard]] std::shared_ptr<const CurrentProfiles> map_currents(const ObservationProduct& product);

/// Depths under a map.
/// errors  of the raster: not_found, format, ... ; not_found: it does not meet the extent
[[nodiscard]] Result<DepthGrid> map_depths(const std::filesystem::path& raster, const GeoExtent& extent);

}  // namespace sonar
