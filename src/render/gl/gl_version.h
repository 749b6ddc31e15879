// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// Version of an OpenGL context.
struct GlVersion {
  int major = 0;
  int minor = 0;
  friend auto operator<=>(const GlVersion&, const GlVersion&) = default;
};
/// What every shader here is written for (macOS stops at it).
inline constexpr GlVersion kLeastGl{4, 1};

/// errors  unsupported: below kLeastGl, with the version and driver found in the line
[[nodiscard]] Result<void> check_version(GlVersion found, const std::string& driver);
/// Version and driver of the context that is current; {0, 0} where none is.
[[nodiscard]] GlVersion current_version();
[[nodiscard]] std::string current_driver();
/// Whether a driver of this name draws on the processor.
[[nodiscard]] bool draws_by_software(std::string_view driver);

}  // namespace sonar
