// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/result.h"
#include "base/time.h"
#include "geo/frames.h"
#include "model/mask.h"
#include "model/volume.h"

namespace sonar {

/// What growing and propagating need of one ping.
struct FilteredPing {
  std::shared_ptr<const Volume> volume;  ///< median-filtered Sv counts, and the flags (seabed included)
  Placement placement;
  TimeNs time = 0;
  PingMask taken;    ///< voxels that already belong to other schools; may be empty
  bool bad = false;  ///< shows nothing of the sea: passed over
};

/// Ping index -> its filtered volume, made when asked for.
using PingProvider = std::function<Result<FilteredPing>(std::int64_t ping_index)>;

}  // namespace sonar
