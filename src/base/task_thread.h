// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

namespace sonar {

/// Whether a job is still asked for; copies speak of the same job.
class CancelToken {
 public:
  [[nodiscard]] bool cancelled() const { return flag_->load(std::memory_order_relaxed); }
  void cancel() const { flag_->store(true, std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

/// One thread that works through jobs in the order in which they came: what must not hold up a window.
/// threads  all members may be called from any thread, but not from a job of its own after destruction began
class TaskThread {
 public:
  /// Looks at the token from time to time and returns early once it is cancelled.
  using Job = std::function<void(const CancelToken& token)>;

  TaskThread();
  /// Cancels all jobs and waits for the one that runs.
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  CancelToken post(Job job);
  /// Latest wins: every earlier job, running or waiting, is cancelled; those that had not begun never run.
  CancelToken post_latest(Job job);
  /// Returns when nothing runs or waits.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sonar
