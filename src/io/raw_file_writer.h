// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/result.h"
#include "io/atomic_file.h"
#include "io/raw_datagrams.h"

namespace sonar {

/// A .raw file being written: there when it is whole, after finish(), and never over a recording that stands there. Move-only.
class RawFileWriter {
 public:
  /// errors  as AtomicFile
  static Result<RawFileWriter> create(const std::filesystem::path& path);

  /// Appends whole datagrams (made by the append_* functions).
  /// errors  io, no_space: the operating system's reason
  Result<void> write(std::span<const std::byte> datagrams);
  /// Bytes written so far.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const { return file_.target(); }
  /// Nothing may be written after it.
  Result<void> finish() { return file_.commit(); }

 private:
  explicit RawFileWriter(AtomicFile file) : file_(std::move(file)) {}

  AtomicFile file_;
  std::uint64_t size_ = 0;
};

}  // namespace sonar
