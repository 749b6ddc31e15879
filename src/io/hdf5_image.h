// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace sonar::netcdf {

/// An HDF5 file's image, taken while it is open, has lost the mark that it is, but not the check sum of its superblock with
/// that mark: sets it right (HDF5 File Format Specification 3.0, II.A, versions 2 and 3; B. Jenkins' lookup3).
/// False where there is no such superblock.
[[nodiscard]] bool seal_superblock(std::span<std::byte> image);

}  // namespace sonar::netcdf
