// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "model/mask.h"
#include "model/ping.h"
#include "pipeline/exports/reduce.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/group_water.h"

namespace sonar {

/// What stays of one ping.
struct ReducedPing {
  Array3<std::int16_t> counts;     ///< power counts; kNoData = left out, kReducedFault = was faulty
  std::vector<ReducedRow> record;  ///< [row]
  std::optional<ReducedSeabed> seabed;
  std::optional<WaterLevels> water;
  std::vector<ReducedChannel> short_beams;  ///< of which nothing is kept, though they end before the ping does
};

/// What else of a ping stays, beside its masks.
struct KeepAlso {
  bool ends = false;        ///< the last sample of each fan's longest beam, which tells how far the beams reached
  bool detections = false;  ///< all that detection finds, school or not
};

/// Picks the samples that decide about the masks of one ping.
/// engine         knows the ping's background
/// errors         as load_volume()
/// waters         of the same engine
[[nodiscard]] Result<ReducedPing> reduce_ping(Engine& engine, GroupWater& waters, std::int64_t ping_index,
                                              const std::vector<const PingMask*>& masks, KeepAlso also,
                                              const ReduceParams& params);

}  // namespace sonar
