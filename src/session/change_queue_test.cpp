// SPDX-License-Identifier: Apache-2.0
#include "session/change_queue.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/task_thread.h"

namespace sonar {
namespace {

TEST(ChangeQueue, WakesOnceATurnAndKeepsOrder) {
  int woken = 0;
  std::vector<int> done;
  ChangeQueue queue([&] { ++woken; });
  for (int i = 0; i < 5; ++i) queue.post([&done, i] { done.push_back(i); });
  EXPECT_EQ(woken, 1);
  EXPECT_EQ(queue.drain(), 5U);
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2, 3, 4}));
  queue.post([] {});
  EXPECT_EQ(woken, 2);
}

TEST(ChangeQueue, WhatAChangePostsWaitsForTheNextTurn) {
  int deep = 0;
  ChangeQueue queue;
  queue.post([&] { queue.post([&] { ++deep; }); });  // would lock up if a change ran under the lock
  EXPECT_EQ(queue.drain(), 1U);
  EXPECT_EQ(deep, 0);
  EXPECT_EQ(queue.drain(), 1U);
  EXPECT_EQ(deep, 1);
}

TEST(ChangeQueue, OnlyTheLastOfANameIsCarriedOut) {
  std::vector<int> shown;
  ChangeQueue queue;
  for (int i = 0; i < 100; ++i) queue.post_latest("progress", [&shown, i] { shown.push_back(i); });
  EXPECT_EQ(queue.drain(), 1U);
  EXPECT_EQ(shown, std::vector<int>{99});
}

TEST(ChangeQueue, TakesChangesFromOtherThreads) {
  int sum = 0;
  ChangeQueue queue;
  TaskThread background;
  for (int i = 1; i <= 100; ++i) {
    background.post([&queue, &sum, i](const CancelToken&) { queue.post([&sum, i] { sum += i; }); });
  }
  background.wait();
  queue.wait();
  queue.drain();
  EXPECT_EQ(sum, 5050);
}

}  // namespace
}  // namespace sonar
