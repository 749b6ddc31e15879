// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "base/time.h"

namespace sonar {

/// A lock that others can read: a file with the host, process and person that hold it, taken away at the end. On one machine
/// the system knows whether the holder lives, whatever it left behind; of another machine's nobody here can tell.
class NamedLock {
 public:
  struct Taken {
    std::string held_by;  ///< empty = the lock is ours; else whose it is
    std::string notice;   ///< what was left behind by a program that has ended, and was taken over
  };
  NamedLock() = default;
  ~NamedLock();
  NamedLock(const NamedLock&) = delete;
  NamedLock& operator=(const NamedLock&) = delete;

  [[nodiscard]] bool held() const { return file_ >= 0; }
  /// Makes the folder where needed.
  /// errors  io, no_space: the file can be neither made nor read
  [[nodiscard]] Result<Taken> take(const std::filesystem::path& file, const std::string& operator_name, TimeNs now);
  void let_go();
  /// Whose it is, without taking it; empty where nobody holds it, as far as can be told here.
  [[nodiscard]] static std::string holder(const std::filesystem::path& file);

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace sonar
