// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/product.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What is known of an observation before anything in it is measured: its name, pings and grid.
[[nodiscard]] ObservationProduct observation_head(const ObservationFiles& observation);

}  // namespace sonar
