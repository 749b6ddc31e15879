// SPDX-License-Identifier: Apache-2.0
#include "base/task_thread.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

namespace sonar {
namespace {

/// Holds a job up until it is opened.
struct Gate {
  std::mutex mutex;
  std::condition_variable changed;
  bool open = false;
  bool reached = false;
  void pass() {
    std::unique_lock lock(mutex);
    reached = true;
    changed.notify_all();
    changed.wait(lock, [&] { return open; });
  }
  void wait_reached() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return reached; });
  }
  void release() {
    const std::scoped_lock lock(mutex);
    open = true;
    changed.notify_all();
  }
};

TEST(TaskThread, JobsRunInTheOrderInWhichTheyCame) {
  std::vector<int> ran;
  TaskThread background;
  for (int i = 0; i < 100; ++i) background.post([&ran, i](const CancelToken&) { ran.push_back(i); });
  background.wait();
  ASSERT_EQ(ran.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(ran[static_cast<std::size_t>(i)], i);
}

TEST(TaskThread, LatestWins) {
  Gate gate;
  std::vector<int> ran;
  bool first_was_given_up = false;
  TaskThread background;
  background.post_latest([&](const CancelToken& token) {
    gate.pass();
    first_was_given_up = token.cancelled();
  });
  gate.wait_reached();
  for (int i = 0; i < 1000; ++i) background.post_latest([&ran, i](const CancelToken&) { ran.push_back(i); });
  gate.release();
  background.wait();
  EXPECT_TRUE(first_was_given_up);
  EXPECT_EQ(ran, std::vector<int>{999});
}

TEST(TaskThread, EndingGivesUpWhatWaits) {
  Gate gate;
  bool ran = false;
  CancelToken waiting;
  {
    TaskThread background;
    background.post([&](const CancelToken& token) {
      gate.pass();
      while (!token.cancelled()) {
      }
    });
    waiting = background.post([&](const CancelToken&) { ran = true; });
    gate.wait_reached();
    gate.release();
  }
  EXPECT_FALSE(ran);
  EXPECT_TRUE(waiting.cancelled());
}

}  // namespace
}  // namespace sonar
