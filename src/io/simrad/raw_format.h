// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "io/byte_source.h"
#include "io/simrad/index.h"

namespace sonar::simrad {

/// By the first bytes; unknown for what is none of the formats, and for fewer than 16 bytes.
/// errors  io
[[nodiscard]] Result<RawFormat> detect_format(const ByteSource& source);
/// Whether a netCDF file says near its beginning that it follows SONAR-netCDF4: a depth raster or a product does not.
/// errors  io
[[nodiscard]] Result<bool> is_sonar_netcdf4(const ByteSource& source);

}  // namespace sonar::simrad
