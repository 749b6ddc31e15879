// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

/// A script of packaging/slurm as it was when the program was built, with its @PLACES@; empty where there is none of that name.
[[nodiscard]] std::string_view slurm_template(std::string_view name);

}  // namespace sonar
