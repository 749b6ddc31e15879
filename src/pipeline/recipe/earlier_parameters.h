// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

// Names of parameters in files that earlier versions wrote: recipes, products and journals hold them.

/// Whether a recipe of version 0.1.0 could name this parameter, and nothing reads it any more.
/// name  with its group: "detect.floor_db"
[[nodiscard]] bool is_gone_parameter(std::string_view name);

/// What the last member of a parameter's name was in 0.1.0: "wall" of "flags.interference"; empty = the same. Version 0.2
/// reads both.
/// name  with its groups, as they are called now
[[nodiscard]] std::string_view earlier_name(std::string_view name);

}  // namespace sonar
