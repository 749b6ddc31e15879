// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sonar {

/// Refuses what is none of these words, and says which was meant.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace sonar
