// SPDX-License-Identifier: Apache-2.0
#include "session/batch/batch_progress.h"

#include <gtest/gtest.h>

#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

Plan plan_of(std::vector<std::int64_t> pings) {
  Plan plan;
  for (const std::int64_t count : pings) {
    plan.tasks.emplace_back();
    plan.tasks.back().pings = count;
  }
  return plan;
}

/// Work tells each stage of an observation, a ping after the other.
void work_on(RunProgress& progress, std::int64_t pings) {
  for (const char* stage : {"background", "detecting", "measuring"}) {
    for (std::int64_t ping = 1; ping <= pings; ++ping) progress.tell(stage, ping, pings);
  }
}

TEST(BatchProgresses, RiseFromNothingToAllPings) {
  RunProgress progress;
  progress.tell("indexing", 1, 3);
  EXPECT_EQ(text_of(progress.now(1.0)), "indexing");
  progress.plan(plan_of({100, 300}), 1.0);
  double before = 0.0;
  for (std::int64_t observation = 0; observation < 2; ++observation) {
    progress.tell(kObservations, observation, 2);
    for (const char* stage : {"background", "detecting", "measuring"}) {
      for (std::int64_t ping = 1; ping <= 50; ++ping) {
        progress.tell(stage, ping, 50);
        const BatchProgress now = progress.now(2.0);
        EXPECT_EQ(now.observation, observation + 1);
        EXPECT_GE(now.share, before);
        before = now.share;
      }
    }
  }
  progress.tell(kObservations, 2, 2);
  progress.tell("merge", 1, 2);
  const BatchProgress end = progress.now(9.0);
  EXPECT_EQ(end.share, 1.0);
  EXPECT_EQ(end.pings, 400);
  EXPECT_EQ(end.of_pings, 400);
  EXPECT_EQ(end.observation, 0) << "what follows the last belongs to none";
}

// 100 of 400 pings in 10 s: 30 s are left.
TEST(BatchProgresses, TimeLeftFollowsFromThePingsThatWereWorkedOn) {
  RunProgress progress;
  progress.plan(plan_of({100, 300}), 5.0);
  progress.tell(kObservations, 0, 2);
  EXPECT_FALSE(progress.now(5.0).left_s);
  work_on(progress, 100);
  progress.tell(kObservations, 1, 2);
  ASSERT_TRUE(progress.now(15.0).left_s);
  EXPECT_DOUBLE_EQ(*progress.now(15.0).left_s, 30.0);
  EXPECT_EQ(text_of(progress.now(15.0)), "observation 2 of 2: measuring, 100 of 400 pings, 30 s left");
}

// 1000 pings were right already and took no time; 100 of the other 200 took 10 s.
TEST(BatchProgresses, WhatWasRightAlreadySaysNothingOfTheTimeLeft) {
  RunProgress progress;
  progress.plan(plan_of({1000, 100, 100}), 0.0);
  progress.tell(kObservations, 0, 3);
  progress.tell(kObservations, 1, 3);
  EXPECT_EQ(progress.now(0.0).pings, 1000);
  EXPECT_FALSE(progress.now(0.0).left_s);
  work_on(progress, 100);
  progress.tell(kObservations, 2, 3);
  EXPECT_EQ(progress.now(10.0).pings, 1100);
  ASSERT_TRUE(progress.now(10.0).left_s);
  EXPECT_DOUBLE_EQ(*progress.now(10.0).left_s, 10.0);
}

TEST(BatchProgresses, AreNothingWhereThereIsNothingToDo) {
  RunProgress progress;
  progress.plan(plan_of({}), 0.0);
  progress.tell(kObservations, 0, 0);
  EXPECT_EQ(progress.now(1.0).share, 0.0);
  EXPECT_FALSE(progress.now(1.0).left_s);
}

TEST(BatchProgresses, DurationsAreAsPeopleSayThem) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(99.0), "99 s");
  EXPECT_EQ(duration_text(720.0), "12 min");
  EXPECT_EQ(duration_text(3.5 * 3600.0), "3.5 h");
}

}  // namespace
}  // namespace sonar
