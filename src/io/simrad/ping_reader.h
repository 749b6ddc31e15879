// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "io/block_pool.h"
#include "io/byte_source.h"
#include "io/raw_index.h"
#include "model/ping.h"

namespace sonar::simrad {

/// As sonar::read_ping().
[[nodiscard]] Result<Ping> read_ping(const ByteSource& source, const PingEntry& entry, BlockPool& pool);

}  // namespace sonar::simrad
