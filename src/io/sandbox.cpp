// SPDX-License-Identifier: Apache-2.0
#include "io/sandbox.h"

#include <fcntl.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>

namespace sonar {
namespace {

void lead_nowhere() {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
}

void close_others(int stream) {
  const auto kept = static_cast<unsigned>(stream);
  if (kept > STDERR_FILENO + 1) ::close_range(STDERR_FILENO + 1, kept - 1, 0);
  ::close_range(kept + 1, ~0U, 0);
}

void limit(int what, std::uint64_t most) {
  const rlimit to{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  ::setrlimit(static_cast<__rlimit_resource_t>(what), &to);
}

std::uint64_t address_space_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Memory, what is open already, the clock, and the end.
constexpr std::array kAlways{SCMP_SYS(read),           SCMP_SYS(pread64),       SCMP_SYS(close),
                             SCMP_SYS(lseek),          SCMP_SYS(fstat),         SCMP_SYS(brk),
                             SCMP_SYS(mremap),         SCMP_SYS(munmap),        SCMP_SYS(mprotect),
                             SCMP_SYS(madvise),        SCMP_SYS(futex),         SCMP_SYS(rt_sigreturn),
                             SCMP_SYS(rt_sigprocmask), SCMP_SYS(sigaltstack),   SCMP_SYS(getpid),
                             SCMP_SYS(gettid),         SCMP_SYS(getrandom),     SCMP_SYS(sched_yield),
                             SCMP_SYS(gettimeofday),   SCMP_SYS(clock_gettime), SCMP_SYS(restart_syscall),
                             SCMP_SYS(exit),           SCMP_SYS(exit_group)};
constexpr std::array kToRead{SCMP_SYS(newfstatat), SCMP_SYS(stat),
                             SCMP_SYS(lstat),      SCMP_SYS(statx),
                             SCMP_SYS(access),     SCMP_SYS(faccessat),
                             SCMP_SYS(faccessat2), SCMP_SYS(readlink),
                             SCMP_SYS(readlinkat), SCMP_SYS(getcwd),
                             SCMP_SYS(getdents64), SCMP_SYS(statfs),
                             SCMP_SYS(fstatfs),    SCMP_SYS(flock),
                             SCMP_SYS(uname),      SCMP_SYS(getuid),
                             SCMP_SYS(geteuid),    SCMP_SYS(getgid),
                             SCMP_SYS(getegid),    SCMP_SYS(fadvise64),
                             SCMP_SYS(sysinfo),    SCMP_SYS(sched_getaffinity)};
/// Of fcntl; making another descriptor of an open one is none of them.
constexpr std::array kOfDescriptors{F_GETFD, F_SETFD, F_GETFL, F_GETLK, F_SETLK, F_SETLKW};

void allow_reading(scmp_filter_ctx filter) {
  for (const int call : kToRead) seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
  for (const int what : kOfDescriptors) {
    const auto asked = static_cast<scmp_datum_t>(what);
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1, SCMP_A1(SCMP_CMP_EQ, asked, 0));
  }
  constexpr auto kChanging = static_cast<scmp_datum_t>(O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND);
  seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(openat), 1, SCMP_A2(SCMP_CMP_MASKED_EQ, kChanging, 0));
  seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(open), 1, SCMP_A1(SCMP_CMP_MASKED_EQ, kChanging, 0));
}

bool allow_little(int stream, Reach reach) {
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) return false;
  for (const int call : kAlways) seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
  const auto to = static_cast<scmp_datum_t>(stream);
  seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(write), 1, SCMP_A0(SCMP_CMP_EQ, to, 0));
  // A file that is open to be written could be changed through a shared mapping.
  seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), 1, SCMP_A3(SCMP_CMP_MASKED_EQ, MAP_SHARED, 0));
  if (reach == Reach::files_to_read) allow_reading(filter);
  if (kSanitized) {
    // Through a pipe it finds out what memory can be read.
    for (const int call : {SCMP_SYS(pipe), SCMP_SYS(pipe2), SCMP_SYS(write)}) {
      seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
    }
  }
  const bool watched = seccomp_load(filter) == 0;
  seccomp_release(filter);
  return watched;
}

}  // namespace

bool enter_sandbox(int stream, Reach reach, std::uint64_t memory_bytes) {
  const std::uint64_t taken = address_space_bytes();
  lead_nowhere();
  if (reach == Reach::nothing) {
    close_others(stream);
    limit(RLIMIT_NOFILE, 0);
  }
  if (!kSanitized && taken > 0) limit(RLIMIT_AS, taken + memory_bytes);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NPROC, 0);
  return allow_little(stream, reach);
}

}  // namespace sonar
