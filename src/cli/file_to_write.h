// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sonar {

/// The name that means standard output.
inline constexpr const char* kStandardOutput = "-";

/// Refuses what would be found out only after the work: that a file cannot be written there. Folders are not made for it.
/// errors  usage: a folder; not_found: its folder is not there
[[nodiscard]] Result<void> require_place(const std::filesystem::path& file);
/// The same of a picture beside other results, asked before the work that it is of. Empty = none is wanted.
/// errors  usage (a name that is no picture's)
[[nodiscard]] Result<void> require_picture_place(const std::filesystem::path& file);

}  // namespace sonar
