// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/map_outlines.h"
#include "model/product.h"

namespace sonar {

/// The outlines of the layers `swept` and `schools` of survey.gpkg, as plain data. Pings without position or heading are
/// left out; a school without such a ping, or without a mask, has an empty area.
/// product  with its masks
/// threads  pure
[[nodiscard]] ObservationOutlines map_outlines(const ObservationProduct& product);

}  // namespace sonar
