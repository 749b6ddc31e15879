// SPDX-License-Identifier: Apache-2.0
#include "io/fed_command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

extern char** environ;

namespace sonar {
namespace {

constexpr int kAskEvery_ms = 100;
constexpr std::size_t kMostComplaints = 1U << 16U;  ///< bytes that are kept

/// The end of what was said: its last line that says something.
std::string last_line(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.remove_suffix(1);
  const auto before = text.find_last_of("\r\n");
  return std::string(before == std::string_view::npos ? text : text.substr(before + 1));
}

void close_end(int& end) {
  if (end >= 0) ::close(std::exchange(end, -1));
}

/// A program of its own group: who stops ours by the keyboard stops ours, which ends it.
int spawn(const std::vector<std::string>& words, int input, int errors, pid_t& pid) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));  // it is only read
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t as_usual;
  ::sigemptyset(&as_usual);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) ::sigaddset(&as_usual, signal);
  ::posix_spawnattr_setsigdefault(&attributes, &as_usual);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int status = ::posix_spawn(&pid, arguments[0], &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return status;
}

}  // namespace

std::optional<std::filesystem::path> program_in_path(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? std::string_view() : std::string_view(path);
  while (!folders.empty()) {
    const auto end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path file = std::filesystem::path(folders.substr(0, end)) / name;
    folders.remove_prefix(std::min(end + 1, folders.size()));
    std::error_code absent;
    if (file.is_absolute() && std::filesystem::is_regular_file(file, absent) && ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  return std::nullopt;
}

Result<FedCommand> FedCommand::start(const std::vector<std::string>& words) {
  const auto refused = [&](int error) {
    return fail(error == ENOENT ? ErrorCode::not_found : ErrorCode::io,
                fmt::format("{}: {}", words[0], std::strerror(error)));
  };
  // A socket, not a pipe: writing to a program that is gone is then an error and no signal.
  std::array<int, 2> input{-1, -1};
  std::array<int, 2> errors{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0) return refused(errno);
  if (::pipe2(errors.data(), O_CLOEXEC) != 0 || ::fcntl(errors[0], F_SETFL, O_NONBLOCK) != 0) {
    const int error = errno;
    for (int* end : {&input[0], &input[1], &errors[0], &errors[1]}) close_end(*end);
    return refused(error);
  }
  pid_t pid = -1;
  const int status = spawn(words, input[1], errors[1], pid);
  close_end(input[1]);
  close_end(errors[1]);
  FedCommand command(std::filesystem::path(words[0]).filename().string(), status == 0 ? pid : -1, input[0], errors[0]);
  if (status != 0) return refused(status);
  return command;
}

FedCommand::FedCommand(FedCommand&& other) noexcept
    : name_(std::move(other.name_)),
      pid_(std::exchange(other.pid_, -1)),
      input_(std::exchange(other.input_, -1)),
      errors_(std::exchange(other.errors_, -1)),
      complaints_(std::move(other.complaints_)) {}

FedCommand::~FedCommand() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    (void)wait();
  }
  close_end(input_);
  close_end(errors_);
}

int FedCommand::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return status;
}

void FedCommand::read_complaints() {
  std::array<char, 4096> text{};
  for (;;) {
    const ssize_t got = ::read(errors_, text.data(), text.size());
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) close_end(errors_);
    if (got <= 0) return;
    complaints_.append(text.data(), static_cast<std::size_t>(got));
    if (complaints_.size() > kMostComplaints) complaints_.erase(0, complaints_.size() - kMostComplaints / 2);
  }
}

tl::unexpected<Error> FedCommand::failed(int status) {
  read_complaints();
  std::string why = last_line(complaints_);
  if (why.empty()) {
    why = WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                              : fmt::format("ended with exit code {}", WEXITSTATUS(status));
  }
  return fail(ErrorCode::io, fmt::format("{} failed: {}", name_, why));
}

Result<void> FedCommand::feed(std::string_view bytes, const std::function<bool()>& stop) {
  while (!bytes.empty()) {
    if (stop()) return fail(ErrorCode::cancelled, "stopped on request");
    if (pid_ <= 0 || input_ < 0) return fail(ErrorCode::io, name_ + " has ended");
    std::array<pollfd, 2> waiting{{{input_, POLLOUT, 0}, {errors_, POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), kAskEvery_ms) < 0 && errno != EINTR) {
      return fail(ErrorCode::io, fmt::format("{}: {}", name_, std::strerror(errno)));
    }
    if (errors_ >= 0 && waiting[1].revents != 0) read_complaints();
    if (waiting[0].revents == 0) continue;
    const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno != EINTR && errno != EAGAIN) {
      ::kill(pid_, SIGKILL);  // it may have closed its input and live on
      return failed(wait());
    }
  }
  return {};
}

Result<void> FedCommand::end(const std::function<bool()>& stop) {
  close_end(input_);
  if (pid_ <= 0) return fail(ErrorCode::io, name_ + " has ended");
  // Its end is seen by the end of its complaints, unless it hands that stream on: then it is asked for.
  for (;;) {
    if (stop()) return fail(ErrorCode::cancelled, "stopped on request");
    int status = 0;
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) {
      pid_ = -1;
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
      return failed(status);
    }
    if (errors_ < 0) {
      ::poll(nullptr, 0, 10);
      continue;
    }
    pollfd waiting{errors_, POLLIN, 0};
    ::poll(&waiting, 1, kAskEvery_ms);
    if (waiting.revents != 0) read_complaints();
  }
}

}  // namespace sonar
