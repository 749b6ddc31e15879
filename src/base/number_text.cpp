// SPDX-License-Identifier: Apache-2.0
#include "base/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace sonar {

std::string shortest(double value) {
  if (std::isnan(value)) return {};
  if (value == 0.0) return "0";
  return fmt::format("{}", value);
}

std::string degrees_text(double degrees) {
  if (std::isnan(degrees)) return {};
  return fmt::format("{:.8f}", degrees);
}

std::string count_of(std::size_t number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

std::string grouped(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

}  // namespace sonar
