// SPDX-License-Identifier: Apache-2.0
#include "base/asked_to_end.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace sonar {
namespace {

std::array<int, 2> ends{-1, -1};  ///< of a pipe: a signal may interrupt anything, and may do nothing but write

void write_end(int /*signal*/) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const auto written = ::write(ends[1], &byte, 1);
  errno = before;
}

}  // namespace

int asked_to_end() {
  if (ends[0] >= 0 || ::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return ends[0];
  struct sigaction once {};
  once.sa_handler = write_end;
  once.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaction(signal, &once, nullptr);
  return ends[0];
}

}  // namespace sonar
