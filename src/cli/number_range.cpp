// SPDX-License-Identifier: Apache-2.0
#include "cli/number_range.h"

#include <fmt/format.h>

#include <string>

namespace sonar {

CLI::Validator within(double least, double most) {
  const auto problem = [least, most](const std::string& text) -> std::string {
    double value = 0.0;
    const bool inside = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return inside ? std::string{} : fmt::format("{} is outside {} .. {}", text, least, most);
  };
  return {problem, fmt::format("FLOAT in [{} - {}]", least, most)};
}

}  // namespace sonar
