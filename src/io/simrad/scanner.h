// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/result.h"
#include "io/byte_source.h"
#include "io/simrad/datagram.h"

namespace sonar::simrad {

/// Diagnostics of one file, with a ceiling: a hostile file must not fill the memory with remarks about itself.
class Notes {
 public:
  static constexpr std::size_t kLimit = 200;
  void set_file(std::string file) { file_ = std::move(file); }
  void add(DiagnosticCode code, std::uint64_t offset, std::string text);
  [[nodiscard]] const Diagnostics& all() const { return notes_; }

 private:
  std::string file_;
  Diagnostics notes_;
};

/// Finds the datagrams of a source that may still grow. Resumable: remembers the first byte not read, takes whole
/// datagrams only, and what it reports does not depend on how the bytes arrived.
/// A short tail is left for the next call. After damage it notes the place and goes on at the next sound datagram:
/// plausible length, known type, plausible date, equal length words.
class Scanner {
 public:
  /// Sees each sound datagram once, in file order; its body is valid during the call only.
  using Visit = std::function<void(const Datagram&)>;

  /// Visits what is whole so far.
  /// errors  io, as the source reports them
  Result<void> scan(const ByteSource& source, const Visit& visit, Notes& notes);
  /// The same, knowing that the source will not grow: looks for sound datagrams in the tail, notes a cut one.
  Result<void> finish(const ByteSource& source, const Visit& visit, Notes& notes);

  /// First byte that belongs to no datagram visited yet.
  [[nodiscard]] std::uint64_t next_offset() const { return next_; }

 private:
  enum class Found { yes, no, need_more };

  Result<void> run(const ByteSource& source, const Visit& visit, Notes& notes, bool final);
  Result<bool> step(const ByteSource& source, const Visit& visit, Notes& notes, bool final);
  Result<bool> resynchronise(const ByteSource& source, bool final);
  Result<bool> tail(const ByteSource& source, Notes& notes);
  Result<Found> trailer_matches(const ByteSource& source, std::uint64_t offset, std::uint32_t length);
  Result<void> visit_datagram(const ByteSource& source, std::uint32_t length, const Visit& visit, Notes& notes);
  /// Up to `count` bytes at `offset`; shorter only where the source ends.
  Result<std::span<const std::byte>> peek(const ByteSource& source, std::uint64_t offset, std::size_t count);

  std::uint64_t next_ = 0;
  bool lost_ = false;  ///< searching for the next sound datagram
  std::uint64_t size_ = 0;
  std::vector<std::byte> window_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace sonar::simrad
