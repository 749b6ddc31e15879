// SPDX-License-Identifier: Apache-2.0
#include "cli/one_of.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "cli/suggestion.h"

namespace sonar {

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string type = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto problem = [words = std::move(words)](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    const std::string meant = suggestion(text, words);
    const std::string hint = meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant);
    return fmt::format("{} is none of {}{}", text, fmt::join(words, ", "), hint);
  };
  return {problem, type};
}

}  // namespace sonar
