// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonar {

/// The shortest decimal text that reads back equal; empty for NaN, so that an unknown value is an empty field.
[[nodiscard]] std::string shortest(double value);
/// Eight decimals, for latitude and longitude in degrees; empty for NaN.
[[nodiscard]] std::string degrees_text(double degrees);
/// "1 ping", "2 pings".
[[nodiscard]] std::string count_of(std::size_t number, std::string_view thing);

/// "1 204": digits in groups of three.
[[nodiscard]] std::string grouped(std::size_t number);

}  // namespace sonar
