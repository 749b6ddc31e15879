// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sonar {

/// Whole numbers between separators, "12,8,10,560"; empty where anything else stands there or a number is too large.
[[nodiscard]] std::optional<std::vector<std::int64_t>> whole_numbers(std::string_view text, char separator);

/// Refuses what is no whole number between least and most.
[[nodiscard]] CLI::Validator whole_within(std::int64_t least, std::int64_t most);
/// Refuses what is no number between least and most; the parser's own range lets "nan" through.
[[nodiscard]] CLI::Validator within(double least, double most);
/// Refuses what is not as many numbers between commas as `kind` has letters: "X,Y,Z", as help shows the value.
[[nodiscard]] CLI::Validator numbers_between_commas(const std::string& kind);

}  // namespace sonar
