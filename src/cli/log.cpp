// SPDX-License-Identifier: Apache-2.0
#include "cli/log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace sonar {
namespace {

std::atomic<LogLevel> chosen{LogLevel::normal};

bool in_colour() {
  const char* none = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe): nobody sets any
  return isatty(STDERR_FILENO) != 0 && (none == nullptr || *none == '\0');
}

void print(const char* colour, std::string_view word, std::string_view line) {
  if (in_colour()) {
    fmt::print(stderr, "\x1b[{}m{}\x1b[0m{}\n", colour, word, line);
  } else {
    fmt::print(stderr, "{}{}\n", word, line);
  }
}

}  // namespace

void set_log_level(LogLevel level) { chosen = level; }
LogLevel log_level() { return chosen; }

void print_error(std::string_view line) { print("31", head_of(RunLine::Kind::failure), line); }

void print_note(std::string_view line) {
  if (log_level() != LogLevel::quiet) print("33", head_of(RunLine::Kind::note), line);
}

void print_detail(std::string_view line) {
  if (log_level() == LogLevel::verbose) print("2", "", line);
}

void print_line(const RunLine& line) {
  switch (line.kind) {
    case RunLine::Kind::note:
      return print_note(line.text);
    case RunLine::Kind::failure:
      return print_error(line.text);
    case RunLine::Kind::result:
    case RunLine::Kind::refused:
      fmt::print("{}\n", line.text);
  }
}

}  // namespace sonar
