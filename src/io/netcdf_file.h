// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "io/atomic_file.h"

namespace sonar::netcdf {

/// The lock round every call into netCDF-C, which is not thread-safe. Held as long as a file is open.
[[nodiscard]] std::unique_lock<std::mutex> lock();

/// A dimension of the file being written.
struct Dimension {
  int id = -1;
  std::size_t length = 0;
};

/// How a variable is stored: in one piece, or in chunks with shuffle and deflate 1.
enum class Storage { plain, packed };

/// Writes one netCDF-4 file, in memory until it is whole: netCDF and HDF5 break where a disk fails under them. After the first
/// failure every further call does nothing and close_into() tells the failure.
/// threads  holds the lock for its lifetime
class Writer {
 public:
  /// named  stands in messages
  explicit Writer(std::string named);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  [[nodiscard]] int root() const { return file_; }
  int group(int parent, const std::string& name);
  Dimension dimension(int group, const std::string& name, std::size_t length);

  static constexpr int kGlobal = -1;  ///< attribute of the group itself
  void attribute(int group, int variable, const std::string& name, std::string_view text);
  void attribute(int group, int variable, const std::string& name, double value);
  void attribute(int group, int variable, const std::string& name, std::int64_t value);
  void attribute(int group, int variable, const std::string& name, const std::vector<std::string>& texts);
  /// Numbers of one kind, as flags of a variable of that kind.
  template <class T>
  void numbers(int group, int variable, const std::string& name, const std::vector<T>& values);

  /// Defines a variable, writes it, and returns its id. Values lie in row-major order; `unit` "" = no attribute.
  /// missing  the number that stands where nothing is known; null = there is none
  template <class T>
  int variable(int group, const std::string& name, std::string_view unit, const std::vector<Dimension>& dimensions,
               const std::vector<T>& values, Storage storage = Storage::plain, const T* missing = nullptr);

  /// Defines a variable of whole arrays that are written one by one along its first dimension.
  /// missing  what stands where nothing is known, and in slices that are never written; null = every slice is written
  template <class T>
  int sliced_variable(int group, const std::string& name, std::string_view unit,
                      const std::vector<Dimension>& dimensions, const T* missing = nullptr);
  /// Writes slice `index` of a sliced_variable().
  template <class T>
  void slice(int group, int variable, std::size_t index, const std::vector<Dimension>& dimensions,
             const std::vector<T>& values);

  /// Remarks a failure that is not netCDF's.
  void refuse(Error error);
  /// Appends the whole file to one that is written.
  /// out  hexadecimal XXH3-128 of its bytes
  [[nodiscard]] Result<std::string> close_into(AtomicFile& file);

 private:
  bool check(int status, std::string_view what);
  [[nodiscard]] Result<std::vector<std::byte>> image();
  int define(int group, const std::string& name, std::string_view unit, const std::vector<Dimension>& dimensions,
             int type, std::size_t value_size, Storage storage);
  std::unique_lock<std::mutex> lock_;
  std::string named_;
  int file_ = -1;
  Result<void> status_;
};

class ReaderProcess;

/// Reads one netCDF-4 file, which may be anything: the library parses it in a process of its own that can reach nothing
/// else, and is asked for one thing after another. As the writer, it remembers the first failure and then gives empty
/// values.
/// threads  those of ChildProcess
class Reader {
 public:
  Reader(const std::filesystem::path& path, std::string named);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[nodiscard]] int root() const { return root_; }
  /// -1, without failure, where there is none.
  [[nodiscard]] int find_group(int parent, const std::string& name);
  [[nodiscard]] int group(int parent, const std::string& name);
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
  /// Says what will be asked for next, in this order: many answers then come on one way there and back.
  template <class T>
  void foresee_values(int group, const std::string& name, std::size_t expected);
  void foresee_variable(int group, const std::string& name);
  /// Number of values of a variable.
  [[nodiscard]] std::size_t size(int group, const std::string& name);

  /// Refuses rows that an honest file of this size has no room for, beside what was read of it before. Whoever makes
  /// room for rows asks first; values() asks itself.
  bool can_hold(std::size_t rows, std::size_t bytes_a_row);

  void refuse(ErrorCode code, std::string text);
  [[nodiscard]] bool ok() const { return status_.has_value(); }
  [[nodiscard]] const Result<void>& status() const { return status_; }

 private:
  void start(const std::filesystem::path& path);
  template <class T>
  T ask(int what, int group, const std::string& name, std::uint64_t number = 0);

  std::unique_ptr<ReaderProcess> process_;  ///< null where none could be made
  std::string named_;
  int root_ = -1;
  Result<void> status_;
};

}  // namespace sonar::netcdf
