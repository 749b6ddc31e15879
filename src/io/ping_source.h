// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "io/block_pool.h"
#include "io/byte_source.h"
#include "io/raw_index.h"
#include "model/ping.h"

namespace sonar {

/// The pings of one recorded file, whole or still being written, whatever its format: where formats begin, and what nothing
/// above looks behind. What it tells does not depend on how the bytes arrived.
/// threads  one for refresh() and finish(); read() any, while neither runs
class PingSource {
 public:
  PingSource() = default;
  virtual ~PingSource() = default;
  PingSource(const PingSource&) = delete;
  PingSource& operator=(const PingSource&) = delete;

  /// Everything about the file so far but its samples; size, hash and diagnostics once it is final.
  [[nodiscard]] virtual const RawIndex& index() const = 0;
  /// Pings published so far: only rises, and none changes, as long as this source lives.
  [[nodiscard]] std::size_t count() const { return index().pings.size(); }
  /// Where a ping lies and what it says of the ship; costs nothing.
  [[nodiscard]] const PingEntry& header(std::size_t i) const { return index().pings[i]; }
  /// A ping's samples.
  /// errors  as read_ping()
  [[nodiscard]] virtual Result<Ping> read(std::size_t i, BlockPool& pool) const = 0;

  /// Takes in what was written since. A ping is published when a later one begins or its last channel is there.
  /// out     how many pings were published
  /// errors  io: what was taken in stays, and the next call goes on there
  virtual Result<std::size_t> refresh() = 0;
  /// No more will come: takes in the rest and completes the index. Called once.
  /// errors  io
  virtual Result<void> finish() = 0;
  [[nodiscard]] virtual bool final() const = 0;
};

[[nodiscard]] std::unique_ptr<PingSource> ping_source(std::shared_ptr<const ByteSource> bytes);
/// Of a whole file whose index is known: final from the beginning.
[[nodiscard]] std::unique_ptr<PingSource> ping_source(std::shared_ptr<const ByteSource> bytes, RawIndex index);

/// Reads the whole file once, in blocks, and indexes it; damage is in the diagnostics.
/// errors  io
/// cost    two passes over the file, the second from memory where it fits; 4 MB beside the index
[[nodiscard]] Result<RawIndex> index_raw(const ByteSource& bytes);

/// Reads one ping of an indexed file: every sound channel of the entry's time, in rising channel order.
/// errors   io; format, where the file is no longer what was indexed
/// threads  any
/// cost     one read of the ping's bytes into one block, which the ping owns; samples are copied only where they lie at
///          an odd address
[[nodiscard]] Result<Ping> read_ping(const ByteSource& bytes, const PingEntry& entry, BlockPool& pool);
[[nodiscard]] Result<Ping> read_ping(const ByteSource& bytes, const PingEntry& entry);

/// What is known of a file whose format is recognised but not read; empty and 0 where it is read.
struct UnreadFormat {
  std::string sounder;
  std::int64_t channels = 0;
};
/// cost  may read the whole file
[[nodiscard]] UnreadFormat unread_format(const ByteSource& bytes, RawFormat format);

}  // namespace sonar
