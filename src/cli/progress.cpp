// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace sonar {
namespace {

constexpr int kBarWidth = 30;

std::string bar(std::int64_t done, std::int64_t total) {
  const auto filled = total > 0 ? static_cast<std::size_t>(done * kBarWidth / total) : 0U;
  return std::string(filled, '#') + std::string(kBarWidth - filled, '.');
}

}  // namespace

void show_progress(Work& work) {
  if (isatty(STDERR_FILENO) == 0) return;
  using Clock = std::chrono::steady_clock;
  work.set_progress(
      [last = Clock::time_point{}](std::string_view stage, std::int64_t done, std::int64_t total) mutable {
        const auto now = Clock::now();
        if (done < total && now - last < std::chrono::milliseconds(100)) return;
        last = now;
        fmt::print(stderr, "\r{:<28} [{}] {}/{}\x1b[K", stage, bar(done, total), done, total);
        std::fflush(stderr);
      });
}

void clear_progress() {
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace sonar
