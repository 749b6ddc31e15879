// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// Parses JSON; the error names the byte.
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text);
/// Reads and parses a file of up to 256 MiB; the error names the file and the byte.
[[nodiscard]] Result<nlohmann::json> read_json_file(const std::string& path);

/// Looks at an integer version member: missing or no integer = format, newer = newer_version (named), older = older_version.
[[nodiscard]] Result<void> check_version(const nlohmann::json& json, const char* member, int current);

}  // namespace sonar
