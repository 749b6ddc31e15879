// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/result.h"
#include "io/byte_source.h"

namespace sonar::simrad {

/// How many channels an EK80 file's samples are of, by the names in its RAW3 datagrams; a thousand at most.
/// errors  io
/// cost    reads the whole file
[[nodiscard]] Result<std::int64_t> ek80_channels(const ByteSource& source);

}  // namespace sonar::simrad
