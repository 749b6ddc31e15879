// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace sonar {

// A product ends with a seal: one line of text with the XXH3-128 of all bytes before it. netCDF and HDF5 take no notice
// of bytes behind the end that they know; our reader refuses a file whose seal is broken. A file that another
// program has changed has none. A seal tells damage, not malice: anybody can make one.

/// Hundreds of pings take some megabytes; a file that only pretends to be as large as it says is not read to its end.
inline constexpr std::uint64_t kMostProductBytes = 4ULL << 30U;

/// hash  hexadecimal XXH3-128 of the bytes before it
[[nodiscard]] std::string seal_text(const std::string& hash);

/// out     whether there is a seal (and it is whole)
/// errors  not_found, io, format: no HDF5 file, or bytes changed since it was written
/// named   stands in messages
Result<bool> check_seal(const std::filesystem::path& path, const std::string& named);

}  // namespace sonar
