// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "geo/frames.h"
#include "model/mask.h"
#include "model/volume.h"

namespace sonar {

/// What an echo has to stand above: each beam's own noise, or that and what the water returns at the range.
enum class Above { noise, water };

/// Where the filtered echo stands so many dB above its background, sorted: as Thresholder tells of a ping.
using AboveBackground = std::function<std::vector<Run>(double margin_db, Above above)>;

/// What growing and propagating need of one ping.
struct FilteredPing {
  std::shared_ptr<const Volume> volume;  ///< median-filtered Sv counts, and the flags (seabed included)
  Placement placement;
  TimeNs time = 0;
  AboveBackground above_background;  ///< null = nothing is known of the background
  PingMask taken;                    ///< voxels that already belong to other schools; may be empty
  bool bad = false;                  ///< shows nothing of the sea: passed over
};

/// Ping index -> its filtered volume, made when asked for.
using PingProvider = std::function<Result<FilteredPing>(std::int64_t ping_index)>;

}  // namespace sonar
