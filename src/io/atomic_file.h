// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// The error of a write that the system refused: no_space where there is no room, else io.
/// error  errno; 0 = not known
[[nodiscard]] tl::unexpected<Error> refused_write(std::string_view what, int error, const std::string& file);

/// A file that appears under its own name only when it is whole: written under a temporary name in the same folder,
/// flushed, renamed, and the folder flushed. Whoever is killed half way leaves the old file as it was.
/// threads  one object belongs to one thread; several may write the same target, the last rename stays
class AtomicFile {
 public:
  /// Makes the folder where needed, and an empty temporary file in it (hidden, same extension as the target).
  /// errors  io
  static Result<AtomicFile> create(const std::filesystem::path& target);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary file unless commit() was called.
  ~AtomicFile();

  /// Where to write; write, close, then commit().
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// errors  io
  Result<void> commit();

 private:
  AtomicFile(std::filesystem::path target, std::filesystem::path temporary);
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed
};

/// Writes a whole file atomically.
/// errors  io, no_space
Result<void> write_file(const std::filesystem::path& target, std::string_view bytes);

/// Reads a whole file; refuses one larger than limit_bytes.
/// errors  not_found, io, format (too large)
Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t limit_bytes = 1ULL << 30);

/// What is asked for before work begins that ends in a product or two, tables and a map.
inline constexpr std::uint64_t kLeastFreeBytes = 32U << 20U;

/// Refuses when the disk that holds `folder` (or its nearest existing parent) has less than `bytes` free.
/// errors  no_space, io
Result<void> require_free_space(const std::filesystem::path& folder, std::uint64_t bytes);

/// Removes temporary files that a killed program of this machine left in a folder; those of living processes stay.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace sonar
