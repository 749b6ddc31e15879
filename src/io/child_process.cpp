// SPDX-License-Identifier: Apache-2.0
#include "io/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "base/library_gate.h"

namespace sonar {
namespace {

[[noreturn]] void child(const std::function<void(int)>& body, int stream) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPIPE}) ::signal(signal, SIG_DFL);
  // Whoever stops the program means the parent, which ends this child: one that ends first looks like a damaged file.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // An abort's last words are for nobody.
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  try {
    body(stream);
  } catch (...) {  // nothing of the parent's may be unwound here; it hears the end
  }
  // At once: whatever is registered to run at the end belongs to the parent. A sandbox allows the second alone.
  ::kill(::getpid(), SIGKILL);
  for (;;) ::syscall(SYS_exit_group, 0);
}

/// Bytes moved by one call, 0 = the other end is gone.
template <class Call>
std::size_t moved(const Call& call) {
  for (;;) {
    const ssize_t count = call();
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return 0;
  }
}

}  // namespace

bool hear_all(int stream, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = moved([&] { return ::read(stream, bytes.data(), bytes.size()); });
    if (count == 0) return false;
    bytes = bytes.subspan(count);
  }
  return true;
}

bool say_all(int stream, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = moved([&] { return ::write(stream, bytes.data(), bytes.size()); });
    if (count == 0) return false;
    bytes = bytes.subspan(count);
  }
  return true;
}

Result<ChildProcess> ChildProcess::start(const std::function<void(int)>& body, const std::string& named) {
  const auto refused = [&] { return fail(ErrorCode::io, std::generic_category().message(errno), {.file = named}); };
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return refused();
  // Above the standard streams, which the child leads nowhere.
  for (int& end : ends) {
    if (end > STDERR_FILENO) continue;
    const int above = ::fcntl(end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    ::close(std::exchange(end, above));
  }
  auto at_rest = libraries_at_rest();
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::close(ends[0]);
    child(body, ends[1]);
  }
  at_rest.unlock();
  ::close(ends[1]);
  ChildProcess made(pid, ends[0]);
  if (pid < 0) return refused();
  return made;
}

ChildProcess::~ChildProcess() {
  if (stream_ >= 0) ::close(stream_);
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

ChildProcess::Heard ChildProcess::hear(std::span<std::byte> bytes, unsigned seconds) const {
  while (!bytes.empty()) {
    pollfd wait{stream_, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(seconds * 1000));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Heard::silence;
    const std::size_t count = moved([&] { return ::read(stream_, bytes.data(), bytes.size()); });
    if (count == 0) return Heard::gone;
    bytes = bytes.subspan(count);
  }
  return Heard::all;
}

bool ChildProcess::say(std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const std::size_t count = moved([&] { return ::send(stream_, bytes.data(), bytes.size(), MSG_NOSIGNAL); });
    if (count == 0) return false;
    bytes = bytes.subspan(count);
  }
  return true;
}

}  // namespace sonar
