// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace sonar {

/// Bytes of memory that this machine has; 8 GB where it is not known.
[[nodiscard]] std::uint64_t machine_memory();

/// Hands what is free in the heap back to the system, as far as the C library can: who works in short turns for weeks need not
/// hold what the largest of them took. The next turn asks for it again.
void give_memory_back();

}  // namespace sonar
