// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/product.h"
#include "pipeline/commands/state.h"
#include "pipeline/stages/engine.h"
#include "school/track/track.h"

namespace sonar {

/// What lay clearly above the background in an observation and became no school, with the judge's reason: in single pings, and what was
/// followed. Sorted by ping and voxel.
[[nodiscard]] std::vector<RefusedEcho> refused_echoes(const Engine& engine, std::span<const DetectedPing> pings,
                                                      const Tracks& tracks);

/// Less those that a human took in after all: what a school has the loudest voxel of, in any ping, is no echo apart.
/// rows  as refused_echoes() has them
[[nodiscard]] std::vector<RefusedEcho> still_refused(std::vector<RefusedEcho> rows, const JournalState& state,
                                                     const BeamGrid& grid);

/// One line for each refused echo of a product: where it was, how loud, and why it is no school.
[[nodiscard]] std::vector<std::string> refusal_lines(const ObservationProduct& product);

}  // namespace sonar
