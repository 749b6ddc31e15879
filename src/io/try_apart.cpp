// SPDX-License-Identifier: Apache-2.0
#include "io/try_apart.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <system_error>

#include "base/library_gate.h"

namespace sonar {
namespace {

[[noreturn]] void child(const std::function<void()>& body, int pipe_end, unsigned seconds) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM}) ::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // An abort's last words are for nobody.
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::alarm(seconds);
  body();
  const char done = 1;
  while (::write(pipe_end, &done, 1) < 0 && errno == EINTR) {
  }
  // Leaves at once: whatever is registered to run at the end belongs to the parent.
  for (;;) ::kill(::getpid(), SIGKILL);
}

enum class Ending { came_to_its_end, ran_out_of_time, broke };

/// errno is what fork() left where no child could be made.
std::optional<Ending> one_try(const std::function<void()>& body, const std::array<int, 2>& ends, unsigned seconds) {
  auto at_rest = libraries_at_rest();
  const pid_t pid = ::fork();
  if (pid == 0) child(body, ends[1], seconds);
  at_rest.unlock();
  const int error = errno;
  ::close(ends[1]);
  char done = 0;
  ssize_t got = -1;
  int status = 0;
  if (pid > 0) {
    while ((got = ::read(ends[0], &done, 1)) < 0 && errno == EINTR) {
    }
    while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(ends[0]);
  errno = error;
  if (pid < 0) return std::nullopt;
  if (got == 1) return Ending::came_to_its_end;
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? Ending::ran_out_of_time : Ending::broke;
}

}  // namespace

Result<void> try_apart(const std::function<void()>& body, const std::string& named, unsigned seconds) {
  // A lock that no gate knows of (a thread's end, the C library's own) may be held while the child is made; then it
  // waits for ever, whatever the file. The next child is made at another moment.
  const unsigned little = std::max(1U, seconds / 12);
  for (const unsigned wait : {little, little, seconds}) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return fail(ErrorCode::io, std::generic_category().message(errno), {.file = named});
    const std::optional<Ending> ending = one_try(body, ends, wait);
    if (!ending) return fail(ErrorCode::io, std::generic_category().message(errno), {.file = named});
    if (*ending == Ending::came_to_its_end) return {};
    if (*ending == Ending::broke) break;
  }
  return fail(ErrorCode::format, "is damaged: reading it breaks netCDF", {.file = named});
}

}  // namespace sonar
