// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/result.h"
#include "io/simrad/writer_datagrams.h"

namespace sonar {

/// A .raw file being written: under a temporary name beside the final one until finish(), which flushes file and
/// folder and renames. A writer that is destroyed without finish() removes its temporary file. Move-only.
class RawFileWriter {
 public:
  /// errors  io: the file cannot be made (the folder must exist)
  static Result<RawFileWriter> create(std::filesystem::path path);
  RawFileWriter(const RawFileWriter&) = delete;
  RawFileWriter& operator=(const RawFileWriter&) = delete;
  RawFileWriter(RawFileWriter&& other) noexcept;
  RawFileWriter& operator=(RawFileWriter&& other) noexcept;
  ~RawFileWriter();

  /// Appends whole datagrams (made by the append_* functions).
  /// errors  io, no_space: the operating system's reason
  Result<void> write(std::span<const std::byte> datagrams);
  /// Bytes written so far.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Flushes, renames to the final name, closes. Nothing may be written after it.
  Result<void> finish();

 private:
  RawFileWriter(std::filesystem::path path, std::filesystem::path temporary, int descriptor);
  void abandon();
  tl::unexpected<Error> failed(const char* what) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace sonar
