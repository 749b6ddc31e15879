// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

/// Why an echo is no school: the figure that a judge looked at, and the limit that it missed.
struct Reason {
  std::string_view judge;
  double figure = 0.0;
  double limit = 0.0;
  std::string_view unit;  ///< of both
};

}  // namespace sonar
