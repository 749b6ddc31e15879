// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/stages/engine.h"

namespace sonar {

/// Neighbouring pings are judged together: the water of a group is told by its pings and some before and behind them.
inline constexpr std::int64_t kGroupPings = 8;
inline constexpr std::int64_t kGroupSide = 3;

/// Both inclusive.
struct PingWindow {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
/// The pings that tell the water of a ping, of an observation of so many.
[[nodiscard]] PingWindow group_window(std::int64_t ping_index, std::int64_t pings);

/// The water of the pings first .. end - 1, told by them and those up to kGroupSide before and behind.
/// pings   in order; null = bad or unreadable
/// out     [of those asked for]; none for those that are not there; reduced ones bring their own
[[nodiscard]] std::vector<std::optional<WaterLevels>> waters_of(std::span<const std::shared_ptr<StagedPing>> pings,
                                                                std::size_t first, std::size_t end,
                                                                const Sector& sector);

/// The water by which detection judged a ping of an observation, worked out again for one ping after the other.
/// threads  one
class GroupWater {
 public:
  /// engine  knows the pings' background; outlives this
  /// work    told of each ping that is staged, and may stop; null = nobody waits
  explicit GroupWater(Engine& engine, Work* work = nullptr) : engine_(engine), work_(work) {}
  /// cost    its first ping stages the whole group
  /// errors  as Engine::staged(), of the ping itself; cancelled
  [[nodiscard]] Result<WaterLevels> of(std::int64_t ping_index);

 private:
  Engine& engine_;
  Work* work_;
  std::int64_t group_ = -1;
  std::vector<std::optional<WaterLevels>> waters_;  ///< of the group's pings
};

}  // namespace sonar
