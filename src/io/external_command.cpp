// SPDX-License-Identifier: Apache-2.0
#include "io/external_command.h"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

extern char** environ;

namespace sonar {
namespace {

/// A pipe whose ends are closed with it.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe(ends.data()) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_end(std::size_t end) {
    if (ends[end] >= 0) ::close(std::exchange(ends[end], -1));
  }
};

/// Both streams to their ends, whichever speaks first.
void read_both(Pipe& output, Pipe& errors, CommandAnswer& answer) {
  while (output.ends[0] >= 0 || errors.ends[0] >= 0) {
    std::array<pollfd, 2> waiting{{{output.ends[0], POLLIN, 0}, {errors.ends[0], POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (waiting[i].fd < 0 || waiting[i].revents == 0) continue;
      std::array<char, 4096> text{};
      const ssize_t got = ::read(waiting[i].fd, text.data(), text.size());
      if (got > 0) (i == 0 ? answer.output : answer.errors).append(text.data(), static_cast<std::size_t>(got));
      if (got == 0) (i == 0 ? output : errors).close_end(0);
      if (got < 0 && errno != EINTR) return;
    }
  }
}

}  // namespace

Result<CommandAnswer> run_command(const std::vector<std::string>& words) {
  Pipe output;
  Pipe errors;
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));  // it is only read
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", 0, 0);
  ::posix_spawn_file_actions_adddup2(&actions, output.ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.ends[1], STDERR_FILENO);
  for (const Pipe* pipe : {&output, &errors}) {
    for (const int end : pipe->ends) ::posix_spawn_file_actions_addclose(&actions, end);
  }
  pid_t child = 0;
  const int status = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (status == ENOENT) return fail(ErrorCode::not_found, fmt::format("there is no program {}", words[0]));
  if (status != 0) return fail(ErrorCode::io, fmt::format("{}: {}", words[0], std::strerror(status)));
  output.close_end(1);
  errors.close_end(1);
  CommandAnswer answer;
  read_both(output, errors, answer);
  int ended = 0;
  while (::waitpid(child, &ended, 0) < 0 && errno == EINTR) {
  }
  answer.exit_code = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
  return answer;
}

std::string shell_word(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace sonar
