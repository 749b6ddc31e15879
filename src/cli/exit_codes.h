// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"

namespace sonar {

/// What the programs return to their caller.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;  ///< or: not equal
inline constexpr int kExitUsage = 2;   ///< wrong usage
inline constexpr int kExitPartly = 3;  ///< some observations or files failed, the others are done
inline constexpr int kExitInterrupted = 130;

[[nodiscard]] constexpr int exit_code_of(ErrorCode code) {
  if (code == ErrorCode::cancelled) return kExitInterrupted;
  return code == ErrorCode::usage || code == ErrorCode::bad_parameter ? kExitUsage : kExitFailed;
}

/// Writes the error as one line to standard error and returns its exit code.
int report(const Error& error);

}  // namespace sonar
