// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

namespace sonar {

/// Whether whoever asked for a job still wants it.
class Wanted {
 public:
  [[nodiscard]] bool operator()() const { return flag_->load(std::memory_order_relaxed); }
  void give_up() const { flag_->store(false, std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(true);
};

/// One thread that works through jobs in the order in which they came: what must not hold up a window.
/// threads  all members may be called from any thread, but not from a job of its own after destruction began
class TaskThread {
 public:
  /// Looks at `wanted` from time to time and returns early when it is not.
  using Job = std::function<void(const Wanted& wanted)>;

  TaskThread();
  /// Gives up all jobs and waits for the one that runs.
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  Wanted post(Job job);
  /// Latest wins: every earlier job, running or waiting, is given up; those that had not begun never run.
  Wanted post_latest(Job job);
  /// Returns when nothing runs or waits.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sonar
