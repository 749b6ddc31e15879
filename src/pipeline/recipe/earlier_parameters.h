// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

// Names of parameters in files that earlier versions wrote: recipes, products, journals, parameters of simulated surveys
// and preferences hold them.

/// Whether a recipe of version 0.1.0 could name this parameter, and nothing reads it any more.
/// name  with its group: "detect.floor_db"
[[nodiscard]] bool is_gone_parameter(std::string_view name);

/// What the last member of a parameter's name was before: "wall" of "flags.interference"; empty = the same. Both are read.
/// name  with its groups, as they are called now
[[nodiscard]] std::string_view earlier_name(std::string_view name);

}  // namespace sonar
