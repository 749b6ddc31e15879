// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/work.h"
#include "pipeline/engine.h"
#include "school/track.h"

namespace sonar {

/// Joins detections to schools, looks again where each school must be and was not seen, lets its sights vote on its masks,
/// and judges what is left.
/// detected  gains what the second look finds
[[nodiscard]] Tracks track_schools(Engine& engine, std::vector<DetectedPing>& detected, Work& work);

}  // namespace sonar
