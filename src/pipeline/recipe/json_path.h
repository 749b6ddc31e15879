// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace sonar {

// JSON has UTF-8 alone, and a path may be any bytes.

/// An absolute path as a text of JSON: as it is; where it is no UTF-8 as a file URI, "file:///cruise/st%F8r" (RFC 8089).
[[nodiscard]] std::string json_text_of(const std::filesystem::path& path);
/// The path of such a text.
[[nodiscard]] std::filesystem::path path_of_json(const std::string& text);

}  // namespace sonar
