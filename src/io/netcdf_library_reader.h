// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/netcdf_file.h"

namespace sonar::netcdf {

/// Deflate never shrinks further than about 1030 to 1: an honest file holds no more bytes of values than this a byte,
/// in all its variables together.
inline constexpr std::uint64_t kBytesPerByte = 1100;

/// Reads one netCDF-4 file that lies in memory. It remembers the first failure and then gives empty values.
class LibraryReader {
 public:
  explicit LibraryReader(std::vector<std::byte> file);
  ~LibraryReader();
  LibraryReader(const LibraryReader&) = delete;
  LibraryReader& operator=(const LibraryReader&) = delete;

  [[nodiscard]] int root() const { return file_; }
  /// -1, without failure, where there is none.
  [[nodiscard]] int find_group(int parent, const std::string& name);
  [[nodiscard]] bool has_variable(int group, const std::string& name);
  [[nodiscard]] bool has_attribute(int group, const std::string& name);
  [[nodiscard]] std::size_t dimension(int group, const std::string& name);

  [[nodiscard]] std::string text(int group, const std::string& name);
  [[nodiscard]] std::int64_t whole(int group, const std::string& name);
  [[nodiscard]] std::vector<std::string> texts(int group, const std::string& name);

  /// Names of a group's variables.
  [[nodiscard]] std::vector<std::string> variables(int group);
  /// Names of a variable's dimensions, slowest first.
  [[nodiscard]] std::vector<std::string> dimensions_of(int group, const std::string& variable);
  /// Attribute of a variable; empty, or NaN, without failure, where there is none of that kind.
  [[nodiscard]] std::string text_of(int group, const std::string& variable, const std::string& name);
  [[nodiscard]] double number_of(int group, const std::string& variable, const std::string& name);

  /// The whole variable, converted to T; refused where it has not exactly `expected` values.
  template <class T>
  [[nodiscard]] std::vector<T> values(int group, const std::string& name, std::size_t expected);
  /// Number of values of a variable.
  [[nodiscard]] std::size_t size(int group, const std::string& name);

  /// Refuses rows that an honest file of this size has no room for, beside what was read of it before. Whoever makes
  /// room for rows asks first; values() asks itself.
  bool can_hold(std::size_t rows, std::size_t bytes_a_row);

  void refuse(ErrorCode code, std::string text);
  [[nodiscard]] bool ok() const { return status_.has_value(); }
  [[nodiscard]] const Result<void>& status() const { return status_; }

 private:
  bool check(int status, std::string_view what);
  int find_variable(int group, const std::string& name);
  std::unique_lock<std::mutex> lock_;
  std::vector<std::byte> bytes_;
  std::uint64_t file_size_;
  std::uint64_t bytes_left_;
  int file_ = -1;
  Result<void> status_;
};

}  // namespace sonar::netcdf
