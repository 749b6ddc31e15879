// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sonar {

/// Holds a journal for one writer: two windows on one survey must not number their lines alike. It goes with the process,
/// however that ends.
class JournalLock {
 public:
  JournalLock() = default;
  ~JournalLock();
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;

  [[nodiscard]] bool held() const { return file_ >= 0; }
  /// Makes the journal's file where there is none.
  /// errors  io: it cannot be opened, or another program writes it
  Result<void> take(const std::filesystem::path& journal);
  void let_go();

 private:
  int file_ = -1;
};

}  // namespace sonar
