// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace sonar {

/// Bytes of memory that this machine has; 8 GB where it is not known.
[[nodiscard]] std::uint64_t machine_memory();

}  // namespace sonar
