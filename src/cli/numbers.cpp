// SPDX-License-Identifier: Apache-2.0
#include "cli/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

namespace sonar {

std::optional<std::vector<std::int64_t>> whole_numbers(std::string_view text, char separator) {
  std::vector<std::int64_t> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data();;) {
    std::int64_t number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) return std::nullopt;
    numbers.push_back(number);
    if (after == end) return numbers;
    if (*after != separator) return std::nullopt;
    at = after + 1;
  }
}

CLI::Validator whole_within(std::int64_t least, std::int64_t most) {
  const auto problem = [least, most](const std::string& text) -> std::string {
    const auto numbers = whole_numbers(text, ',');
    const bool inside = numbers && numbers->size() == 1 && numbers->front() >= least && numbers->front() <= most;
    return inside ? std::string{} : fmt::format("{} is no whole number in {} .. {}", text, least, most);
  };
  return {problem, fmt::format("INT in [{} - {}]", least, most)};
}

CLI::Validator within(double least, double most) {
  const auto problem = [least, most](const std::string& text) -> std::string {
    double value = 0.0;
    if (!CLI::detail::lexical_cast(text, value)) return fmt::format("{} is no number", text);
    const bool inside = value >= least && value <= most;
    return inside ? std::string{} : fmt::format("{} is outside {} .. {}", text, least, most);
  };
  return {problem, fmt::format("FLOAT in [{} - {}]", least, most)};
}

CLI::Validator numbers_between_commas(const std::string& kind) {
  const std::size_t count = CLI::detail::split(kind, ',').size();
  const auto problem = [kind, count](const std::string& text) -> std::string {
    const std::vector<std::string> parts = CLI::detail::split(text, ',');
    const bool all = std::all_of(parts.begin(), parts.end(), [](const std::string& part) {
      double value = 0.0;
      return CLI::detail::lexical_cast(part, value) && std::isfinite(value);
    });
    return all && parts.size() == count ? std::string{}
                                        : fmt::format("{} is not {}, {} numbers between commas", text, kind, count);
  };
  return {problem, kind};
}

}  // namespace sonar
