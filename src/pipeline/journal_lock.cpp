// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "io/atomic_file.h"

namespace sonar {

JournalLock::~JournalLock() { let_go(); }

void JournalLock::let_go() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

Result<void> JournalLock::take(const std::filesystem::path& journal) {
  const int file = ::open(journal.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) {
    return refused_write("could not be written", errno, journal.string());
  }
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(file);
    return fail(ErrorCode::io, "another window is at work on this survey: nothing is changed here until it is closed",
                {journal.string()});
  }
  file_ = file;  // file systems without locks have one writer, as long as humans see to it
  return {};
}

}  // namespace sonar
