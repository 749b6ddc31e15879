// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "io/byte_source.h"

namespace sonar::simrad {

/// A stretch of a file.
struct Extent {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// The datagrams that tell how a file ends: the last one of samples, and the ship's sentences from where one of those that tell
/// a position speaks for the second time: each that speaks as often is among them then. They are found by walking back over the
/// length words that end each datagram; where the last was cut off in writing, from the last whole one.
/// from       how far back to look
/// positions  whether they are waited for
/// out        in file order; empty where no whole datagram ends in the last 256 kB
/// errors     io
[[nodiscard]] Result<std::vector<Extent>> last_datagrams(const ByteSource& bytes, std::uint64_t size,
                                                         std::uint64_t from, bool positions);

}  // namespace sonar::simrad
