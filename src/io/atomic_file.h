// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sonar {

/// The error of a write that the system refused: no_space where there is no room, else io.
/// error  errno; 0 = not known
[[nodiscard]] tl::unexpected<Error> refused_write(std::string_view what, int error, const std::string& file);

/// Writes all of it to an open file. 0, or errno.
[[nodiscard]] int write_all(int descriptor, std::string_view bytes);

/// What stands round a file that is written.
enum class Beside : std::uint8_t {
  named_folder,  ///< a user named the folder, perhaps by a link; no recordings lie in it
  own_folder,    ///< the program makes the folder inside one that a user named; a link in its place is refused
  users_cache,   ///< the program's folder in the user's cache; what a power cut loses of it is made again
  recordings     ///< a recording among others
};

/// A file that appears under its own name only when it is whole: written under a temporary name in the same folder,
/// flushed, renamed, and the folder flushed. Whoever is killed half way leaves the old file as it was. Every file of this
/// program is made here (a journal, which grows, apart), and two things never happen: a write through a link, and one over
/// a recording or beside recordings.
/// threads  one object belongs to one thread; several may write the same target, the last rename stays
class AtomicFile {
 public:
  /// Makes the folder where needed, and an empty temporary file in it (hidden, same extension as the target).
  /// errors  io, no_space; usage: a recording stands there, or recordings lie beside it
  static Result<AtomicFile> create(const std::filesystem::path& target, Beside beside = Beside::named_folder);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary file unless commit() was called.
  ~AtomicFile();

  /// Appends; what a library writes by itself goes to temporary().
  /// errors  io, no_space
  Result<void> write(std::string_view bytes);
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }
  /// errors  io, no_space; usage: a recording stands there by now
  Result<void> commit();

 private:
  AtomicFile(std::filesystem::path target, Beside beside, int folder)
      : target_(std::move(target)), beside_(beside), folder_(folder) {}
  [[nodiscard]] Result<void> make_temporary();
  [[nodiscard]] Result<void> flush_temporary() const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed
  Beside beside_ = Beside::named_folder;
  int folder_ = -1;
  int file_ = -1;
};

/// Writes a whole file atomically.
/// errors  as AtomicFile
Result<void> write_file(const std::filesystem::path& target, std::string_view bytes,
                        Beside beside = Beside::named_folder);

/// Reads a whole file; refuses one larger than limit_bytes.
/// errors  not_found, io, format (too large)
Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t limit_bytes = 1ULL << 30);

/// What is asked for before work begins that ends in a product or two, tables and a map.
inline constexpr std::uint64_t kLeastFreeBytes = 32U << 20U;

/// Refuses when the disk that holds `folder` (or its nearest existing parent) has less than `bytes` free.
/// errors  no_space, io
Result<void> require_free_space(const std::filesystem::path& folder, std::uint64_t bytes);

/// A folder that the program makes inside one that a user named: refuses a link in its place, for what lies behind it is
/// not ours to write or remove. One that is not there is fine.
/// errors  io
Result<void> require_own_folder(const std::filesystem::path& folder);

/// Removes temporary files that a killed program of this machine left in a folder; those of living processes stay.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace sonar
