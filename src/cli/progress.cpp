// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "cli/log.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kBetween{100};
constexpr double kLeastShare = 0.02;  ///< from which on the time left is told

std::string bar(std::int64_t done, std::int64_t total) {
  const auto filled = total > 0 ? static_cast<std::size_t>(done * kBarWidth / total) : 0U;
  return std::string(filled, '#') + std::string(kBarWidth - filled, '.');
}

std::string span_text(double seconds) {
  const std::int64_t whole = std::llround(seconds);
  if (whole < 100) return fmt::format("{} s", whole);
  return whole < 6000 ? fmt::format("{} min", (whole + 30) / 60) : fmt::format("{:.1f} h", seconds / 3600.0);
}

/// One line that is drawn over itself.
class ProgressLine {
 public:
  void tell(std::string_view stage, std::int64_t done, std::int64_t total) {
    const auto now = Clock::now();
    if (stage == kObservations) return begin_observation(done, total, now);
    if (stage != stage_) {
      stage_ = stage;
      stage_begun_ = now;
    }
    if (done < total && now - drawn_ < kBetween) return;
    drawn_ = now;
    fmt::print(stderr, "\r{}{:<20} [{}] {}/{}{}\x1b[K", observation_, stage, bar(done, total), done, total,
               left_text(done, total, now));
    std::fflush(stderr);
  }
  /// Makes room for another line; what is told next is drawn below it.
  void hide() {
    fmt::print(stderr, "\r\x1b[K");
    drawn_ = {};
  }

 private:
  /// What follows the last observation belongs to none.
  void begin_observation(std::int64_t done, std::int64_t total, Clock::time_point now) {
    const bool over = done >= total;
    observation_ = over ? "" : fmt::format("observation {} of {}: ", done + 1, total);
    if (done == 0) begun_ = now;
    observations_done_ = over ? 0 : done;
    observations_ = total;
  }
  /// Of all observations once one is done, of the stage before; empty while nobody can know.
  [[nodiscard]] std::string left_text(std::int64_t done, std::int64_t total, Clock::time_point now) const {
    const bool by_observations = observations_done_ > 0;
    const double share = by_observations ? static_cast<double>(observations_done_) / static_cast<double>(observations_)
                         : total > 0     ? static_cast<double>(done) / static_cast<double>(total)
                                         : 0.0;
    if (share < kLeastShare || share >= 1.0) return {};
    const double took_s = std::chrono::duration<double>(now - (by_observations ? begun_ : stage_begun_)).count();
    return fmt::format(", {} left{}", span_text(took_s * (1.0 - share) / share), by_observations ? "" : " of this");
  }

  std::string stage_;
  std::string observation_;
  std::int64_t observations_done_ = 0;
  std::int64_t observations_ = 0;
  Clock::time_point drawn_;
  Clock::time_point begun_;
  Clock::time_point stage_begun_;
};

/// What --verbose tells; empty where nothing begins.
std::string step_text(std::string_view stage, std::int64_t done, std::int64_t total) {
  if (stage != kObservations) return fmt::format("{}: {}", stage, total);
  return done < total ? fmt::format("observation {} of {}", done + 1, total) : "";
}

bool is_shown() { return isatty(STDERR_FILENO) != 0 && log_level() != LogLevel::quiet; }

}  // namespace

void show_progress(Work& work) {
  const bool shown = is_shown();
  const bool steps = log_level() == LogLevel::verbose;
  if (!shown && !steps) return;
  work.set_progress([shown, steps, line = ProgressLine(), last = std::string()](
                        std::string_view stage, std::int64_t done, std::int64_t total) mutable {
    const std::string step = steps ? step_text(stage, done, total) : "";
    if (!step.empty() && step != last) {
      if (shown) line.hide();
      print_detail(step);
      last = step;
    }
    if (shown) line.tell(stage, done, total);
  });
}

void clear_progress() {
  if (is_shown()) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace sonar
