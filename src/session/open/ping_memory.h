// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/array.h"
#include "base/result.h"

namespace sonar {

/// What one ping of a grid takes in memory, bytes.
struct PingMemory {
  std::uint64_t kept = 0;     ///< its stages, while it is kept
  std::uint64_t working = 0;  ///< all that is there while it is read, and while pictures of it are drawn
};
[[nodiscard]] PingMemory ping_memory(const Shape3& shape);

/// Half of this machine's memory, bytes.
[[nodiscard]] std::uint64_t usual_memory();

/// Pings to each side that may be kept within a budget; at most `wanted`.
/// errors  no_space: not even one ping can be read, saying what it takes and what there is
[[nodiscard]] Result<std::int64_t> reach_within(std::uint64_t budget, const Shape3& shape, std::int64_t wanted);

}  // namespace sonar
