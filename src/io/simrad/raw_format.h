// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "base/result.h"
#include "io/byte_source.h"
#include "io/raw_index.h"

namespace sonar::simrad {

/// By the first bytes, of netCDF by whether it says in its first MB that it follows SONAR-netCDF4; unknown for what is
/// none of the formats, and for fewer than 16 bytes.
/// errors  io
[[nodiscard]] Result<RawFormat> detect_format(const ByteSource& source);
/// Why a netCDF file is not read; empty for formats that are looked into.
[[nodiscard]] std::string_view why_not_read(RawFormat format);

/// How many channels an EK80 file's samples are of, by the names in its RAW3 datagrams; a thousand at most.
/// errors  io
/// cost    reads the whole file
[[nodiscard]] Result<std::int64_t> ek80_channels(const ByteSource& source);

}  // namespace sonar::simrad
