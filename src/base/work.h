// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace sonar {

/// A task pool with progress and cancel. The number of threads never changes a result.
/// threads  for_each may be called from inside for_each (nested work is shared out too)
class Work {
 public:
  using ProgressSink = std::function<void(std::string_view stage, std::int64_t done, std::int64_t total)>;

  /// threads = 0 takes what the machine has, 16 at most.
  explicit Work(int threads = 0);
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  /// Runs body(0) .. body(count - 1), in any order, on any threads; returns when all are done or the work was
  /// cancelled. An exception thrown by a body is rethrown here after the others have stopped.
  void for_each(std::int64_t count, const std::function<void(std::int64_t)>& body);

  /// Asks running work to stop early; callers check cancelled() after for_each. Safe in signal handlers.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

  /// Where progress goes; called from any thread, one call at a time. Empty = nowhere.
  void set_progress(ProgressSink sink);
  /// The same, and gives back where it went before: for who tells of a whole instead of its parts.
  [[nodiscard]] ProgressSink exchange_progress(ProgressSink sink);
  void progress(std::string_view stage, std::int64_t done, std::int64_t total);

 private:
  struct Pool;
  int threads_;
  std::atomic<bool> cancelled_{false};
  std::unique_ptr<Pool> pool_;
};

}  // namespace sonar
