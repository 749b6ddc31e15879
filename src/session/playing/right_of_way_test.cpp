// SPDX-License-Identifier: Apache-2.0
#include "session/playing/right_of_way.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/task_thread.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

TEST(RightOfWayJobs, WhoGivesWayGoesOnWhenTheLastOneLetsGo) {
  RightOfWay way;
  EXPECT_FALSE(way.give_way(std::chrono::hours(1))) << "nobody has it";
  auto first = way.take();
  auto second = way.take();
  std::atomic<bool> free{false};
  std::atomic<bool> went_on_free{false};
  TaskThread behind;
  behind.post([&](const CancelToken&) {
    (void)way.give_way(std::chrono::hours(1));
    went_on_free = free.load();
  });
  first.reset();
  free = true;
  second.reset();
  behind.wait();
  EXPECT_TRUE(went_on_free);
  EXPECT_EQ(way.taken(), 2);
}

TEST(RightOfWayJobs, AUserWhoNeverRestsDoesNotStopAJob) {
  RightOfWay way;
  const auto held = way.take();
  GivesWay give(way);
  for (int step = 0; step < 1000; ++step) give();
  EXPECT_GE(way.given(), 1);
  EXPECT_LT(way.given(), 1000);
}

TEST(RightOfWayJobs, MeasuringAndSearchingGiveWayToAPingThatIsWaitedFor) {
  ChangeQueue queue;
  Document document(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  document.open({TestSurvey::easy().folder()});
  document.settle();
  const std::int64_t before = document.right_of_way().taken();
  document.look_at(9);
  document.settle();
  EXPECT_EQ(document.right_of_way().taken(), before + 1) << "a user waits for the ping";
  const std::int64_t given = document.right_of_way().given();
  {
    const auto held = document.right_of_way().take();
    document.detect({0});  // schools are found, and then measured
    document.settle();
  }
  EXPECT_GT(document.right_of_way().given(), given);
  ASSERT_TRUE(document.product(0));
  EXPECT_EQ(document.product(0)->schools.size(), 2U);
}

}  // namespace
}  // namespace sonar
