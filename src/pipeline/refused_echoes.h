// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/product.h"
#include "pipeline/engine.h"
#include "school/track.h"

namespace sonar {

/// What stood out clearly in an observation and became no school, with the judge's reason: in single pings, and what was
/// followed. Sorted by ping and voxel.
[[nodiscard]] std::vector<RefusedEcho> refused_echoes(const Engine& engine, std::span<const DetectedPing> pings,
                                                      const Tracks& tracks);

/// One line for each refused echo of a product: where it was, how loud, and why it is no school.
[[nodiscard]] std::vector<std::string> refusal_lines(const ObservationProduct& product);

}  // namespace sonar
