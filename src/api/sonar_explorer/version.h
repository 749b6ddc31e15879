// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// Versions are 0.y.z: y rises with a changed interface.
#define SONAR_EXPLORER_VERSION_MAJOR 0
#define SONAR_EXPLORER_VERSION_MINOR 2
#define SONAR_EXPLORER_VERSION_PATCH 0
/// 200 for 0.2.0: to be compared by the preprocessor.
#define SONAR_EXPLORER_VERSION \
  (SONAR_EXPLORER_VERSION_MAJOR * 10000 + SONAR_EXPLORER_VERSION_MINOR * 100 + SONAR_EXPLORER_VERSION_PATCH)

namespace sonar_explorer {

/// "0.2.0", of the library that is linked.
[[nodiscard]] std::string version();

}  // namespace sonar_explorer
