// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// Whether a file's name ends so (".raw"), in any case of letters.
[[nodiscard]] bool has_ending(const std::filesystem::path& file, std::string_view ending);

/// Whether a file is named as recordings are: .raw, in any case of letters.
[[nodiscard]] bool is_named_raw(const std::filesystem::path& file);

/// Whether a folder's file is one of its recordings: named so, or a SONAR-netCDF4 file, which is told though not read.
/// Products and rasters lie in such folders as well.
[[nodiscard]] bool is_named_recording(const std::filesystem::path& file);

/// Whether a file is, or may be, the recording of an echo sounder: it begins as one, or is named as one and not empty;
/// false where nothing stands there.
[[nodiscard]] bool is_recording(const std::filesystem::path& file);

/// Whether a folder holds a file that is named as recordings are and begins as one.
[[nodiscard]] bool holds_recordings(const std::filesystem::path& folder);

}  // namespace sonar
