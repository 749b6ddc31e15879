// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"

namespace sonar {

/// Bytes that may grow at the end and never change before it: a file, memory, a file that is still being written.
/// threads  all const members may be called from any thread
class ByteSource {
 public:
  ByteSource() = default;
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// As the user named it.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Bytes that can be read now; a later call may return more.
  [[nodiscard]] virtual Result<std::uint64_t> size() const = 0;
  /// Fills `out` from `offset`; returns how many bytes were there (fewer only at the end).
  /// errors  io
  [[nodiscard]] virtual Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

/// A file, read with pread and never mapped: a mapping counts as our memory, and a file cut short under it kills us.
/// errors  not_found, io
[[nodiscard]] Result<std::shared_ptr<const ByteSource>> open_file(const std::filesystem::path& path);

/// A file that somebody else is still writing, looked for by its path at every call and never held open: it may be gone for a
/// while with the disk that it lies on, and no writer is ever in our way.
/// errors  of its members: also not_found; mismatch: it is shorter than it was, or begins otherwise: another file
[[nodiscard]] std::shared_ptr<const ByteSource> growing_file(const std::filesystem::path& path);

/// The same bytes, until the work is cancelled: then reading fails, so that whoever reads on and on stops soon.
/// errors  of its members: also cancelled
[[nodiscard]] std::shared_ptr<const ByteSource> stoppable(std::shared_ptr<const ByteSource> source, const Work& work);

/// Bytes in memory that may be appended to while others read.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string name, std::span<const std::byte> bytes = {});
  void append(std::span<const std::byte> bytes);

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Result<std::uint64_t> size() const override;
  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override;

 private:
  std::string name_;
  mutable std::mutex mutex_;
  std::vector<std::byte> bytes_;
};

}  // namespace sonar
