// SPDX-License-Identifier: Apache-2.0
#include "session/open/ping_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/machine_memory.h"

namespace sonar {
namespace {

/// Sv, filtered Sv, and the flags of both.
constexpr std::uint64_t kKeptPerVoxel = 6;
/// Power and flags of a ping and its two neighbours, a copy that is calibrated, the calibration's table, and the flags that
/// slices draw.
constexpr std::uint64_t kReadingPerVoxel = 9 + 3 + 2 + 2;
/// What is drawn in three dimensions: a copy without what is left out, and one whose gaps are filled.
constexpr std::uint64_t kDrawingPerVoxel = 3 + 2 + 3;

}  // namespace

PingMemory ping_memory(const Shape3& shape) {
  const auto voxels = static_cast<std::uint64_t>(std::max(0, shape.fans)) *
                      static_cast<std::uint64_t>(std::max(0, shape.beams)) *
                      static_cast<std::uint64_t>(std::max(0, shape.samples));
  return {voxels * kKeptPerVoxel, voxels * (kKeptPerVoxel + std::max(kReadingPerVoxel, kDrawingPerVoxel))};
}

std::uint64_t usual_memory() { return machine_memory() / 2; }

Result<std::int64_t> reach_within(std::uint64_t budget, const Shape3& shape, std::int64_t wanted) {
  const PingMemory ping = ping_memory(shape);
  if (ping.working > budget) {
    return fail(ErrorCode::no_space,
                fmt::format("a ping of {} x {} x {} samples takes {:.1f} GB of memory, and {:.1f} GB may be used "
                            "(memory_gb in the preferences)",
                            shape.fans, shape.beams, shape.samples, static_cast<double>(ping.working) / 1e9,
                            static_cast<double>(budget) / 1e9));
  }
  const std::uint64_t more = ping.kept == 0 ? 0 : (budget - ping.working) / ping.kept;
  return ping.kept == 0 ? wanted : std::min<std::int64_t>(wanted, static_cast<std::int64_t>(more / 2));
}

}  // namespace sonar
