// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/work.h"
#include "model/product.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/engine.h"
#include "school/track/track.h"

namespace sonar {

/// What may be schools in the pings of an observation, each judged by the water of the pings round it. Bad pings and
/// those that cannot be read are left out, and the latter are marked in the product and noted.
/// memory  some pings for each thread, and what the engine keeps of those with detections
[[nodiscard]] std::vector<DetectedPing> detect_pings(Engine& engine, PingReach reach, ObservationProduct& product,
                                                     Work& work);

}  // namespace sonar
