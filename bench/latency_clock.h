// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace sonar::bench {

/// A wrong answer ends the program: nothing is timed that is not right.
inline void must(bool right, const std::string& what) {
  if (right) return;
  fmt::print(stderr, "wrong answer: {}\n", what);
  std::exit(EXIT_FAILURE);
}

[[nodiscard]] inline double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace sonar::bench
