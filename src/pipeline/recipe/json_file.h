// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// Parses JSON that nests up to 100 deep; the error names the byte.
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text);
/// Reads and parses a file of up to 256 MiB; the error names the file and the byte.
[[nodiscard]] Result<nlohmann::json> read_json_file(const std::string& path);

/// Writes JSON, indented by two, whole or not at all; what is no UTF-8 is replaced. errors: io, no_space
[[nodiscard]] Result<void> write_json_file(const std::string& path, const nlohmann::json& json);

/// A whole number within bounds; empty where it is anything else.
[[nodiscard]] std::optional<std::int64_t> whole_number(const nlohmann::json& json,
                                                       std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                                                       std::int64_t most = std::numeric_limits<std::int64_t>::max());

/// Looks at an integer version member: missing or no integer = format, newer = newer_version (named), older = older_version.
[[nodiscard]] Result<void> check_version(const nlohmann::json& json, const char* member, int current);

}  // namespace sonar
