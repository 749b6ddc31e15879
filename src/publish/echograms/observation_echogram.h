// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/result.h"
#include "base/work.h"
#include "model/navigation.h"
#include "publish/picture_source.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

/// All beams of every ping, from the user's cache, or made and kept there. Null without raw files.
/// level   of the pyramid that is the finest wanted
/// errors  unsupported (no grid); io; cancelled
[[nodiscard]] Result<std::unique_ptr<EchogramPyramid>> observation_echogram(DrawnObservation& observation,
                                                                            bool filtered, int level, Work& work);

/// The ping with the most ranges at which a beam reaches the level, bad ones left out; empty where none does.
/// echogram  with one ping a column
[[nodiscard]] std::optional<std::int64_t> fullest_ping(const EchogramPyramid& echogram,
                                                       std::span<const PingNavigation> pings, double level_db);

}  // namespace sonar
