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

/// The datagrams that tell how a file ends: the last one of samples, and the ship's sentences from the last position on. They
/// are found by walking back over the length words that end each datagram, which costs reading little more than a ping.
/// from     how far back to look
/// out      in file order; empty where the file does not end with a whole datagram
/// errors   io
[[nodiscard]] Result<std::vector<Extent>> last_datagrams(const ByteSource& bytes, std::uint64_t size,
                                                         std::uint64_t from);

}  // namespace sonar::simrad
