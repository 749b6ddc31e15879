// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace sonar {

/// Writes bytes under a temporary name beside `file` and renames it when whole.
/// errors  io
[[nodiscard]] Result<void> write_picture_file(const std::string& bytes, const std::filesystem::path& file);

}  // namespace sonar
