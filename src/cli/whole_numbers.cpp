// SPDX-License-Identifier: Apache-2.0
#include "cli/whole_numbers.h"

#include <charconv>

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

}  // namespace sonar
