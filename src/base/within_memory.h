// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <new>
#include <type_traits>

#include "base/result.h"

namespace sonar {

/// Runs what returns a Result (or nothing: then gives a Result<void>); memory that runs out is an error like any other.
/// errors  those of the work; no_space: there was not enough memory
template <class Job>
[[nodiscard]] auto within_memory(Job&& job) {
  using Out = std::invoke_result_t<Job>;
  using Given = std::conditional_t<std::is_void_v<Out>, Result<void>, Out>;
  try {
    if constexpr (std::is_void_v<Out>) {
      job();
      return Given{};
    } else {
      return Given(job());
    }
  } catch (const std::bad_alloc&) {
    return Given(fail(ErrorCode::no_space, "there is not enough memory for this"));
  }
}

}  // namespace sonar
