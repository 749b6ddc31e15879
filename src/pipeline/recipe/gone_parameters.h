// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

/// Whether a recipe of version 0.1.0 could name this parameter, and nothing reads it any more. Such recipes are read all the
/// same: products and journals hold them.
/// name  with its group: "detect.floor_db"
[[nodiscard]] bool is_gone_parameter(std::string_view name);

}  // namespace sonar
