// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "io/block_pool.h"
#include "io/byte_source.h"
#include "io/simrad/index.h"
#include "model/ping.h"

namespace sonar {

/// Reads one ping of an indexed file: every sound channel of the entry's time, in rising channel order.
/// errors   io; format, where the file is no longer what was indexed
/// threads  any
/// cost     one read of the ping's bytes into one block, which the ping owns; samples are copied only where they lie at
///          an odd address
[[nodiscard]] Result<Ping> read_ping(const ByteSource& source, const PingEntry& entry, BlockPool& pool);
[[nodiscard]] Result<Ping> read_ping(const ByteSource& source, const PingEntry& entry);

}  // namespace sonar
