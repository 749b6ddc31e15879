// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace sonar {

/// The shortest decimal text that reads back equal; empty for NaN, so that an unknown value is an empty field.
[[nodiscard]] std::string shortest(double value);
/// Eight decimals, for latitude and longitude in degrees; empty for NaN.
[[nodiscard]] std::string degrees_text(double degrees);

}  // namespace sonar
