// SPDX-License-Identifier: Apache-2.0
#include "session/open/ping_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <vector>

#include "session/test_survey.h"

namespace sonar {
namespace {

using testing::HasSubstr;

constexpr Shape3 kHuge{200, 200, 10000};

// 4e8 voxels: Sv and filtered Sv of 2 bytes, two flags of 1.
TEST(PingMemory, OfAHugeGridIsWorkedOutBeforeItIsTaken) {
  EXPECT_EQ(ping_memory(kHuge).kept, 2'400'000'000U);
  const auto refused = reach_within(4'000'000'000, kHuge, 5);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::no_space);
  EXPECT_THAT(refused.error().text, HasSubstr("200 x 200 x 10000 samples takes"));
  EXPECT_THAT(refused.error().text, HasSubstr("4.0 GB may be used (memory_gb"));
  EXPECT_EQ(reach_within(ping_memory(kHuge).working, kHuge, 5), 0);
  EXPECT_EQ(reach_within(std::uint64_t{1} << 62U, kHuge, 5), 5);
  EXPECT_EQ(reach_within(100, Shape3{}, 5), 5);
}

TEST(PingMemory, WhatIsKeptStaysWithinTheBudgetAndGrowsWithIt) {
  const PingMemory ping = ping_memory(kHuge);
  std::int64_t before = 0;
  for (std::uint64_t budget = ping.working; budget < 20 * ping.working; budget += ping.kept / 3) {
    const std::int64_t reach = *reach_within(budget, kHuge, 100);
    EXPECT_LE(2 * static_cast<std::uint64_t>(reach) * ping.kept + ping.working, budget);
    EXPECT_GE(reach, before);
    before = reach;
  }
  EXPECT_GT(before, 10);
}

/// Makes pings out of nothing, and tells which.
struct Made {
  std::shared_ptr<std::vector<std::int64_t>> made = std::make_shared<std::vector<std::int64_t>>();
  [[nodiscard]] StagedPingSource source() const {
    return [made = made](std::int64_t i) -> Result<StagedPingPtr> {
      made->push_back(i);
      auto ping = std::make_shared<StagedPing>();
      ping->ping_index = i;
      return StagedPingPtr(ping);
    };
  }
};

TEST(PingCacheJobs, MemoryThatRunsOutIsAnErrorAndTheNextPingComes) {
  PingCache cache(
      [](std::int64_t i) -> Result<StagedPingPtr> {
        if (i == 3) throw std::bad_alloc();
        return StagedPingPtr(std::make_shared<StagedPing>());
      },
      10, 0);
  Result<StagedPingPtr> arrived = fail(ErrorCode::usage, "nothing came");
  cache.look_at(3, [&](const Result<StagedPingPtr>& ping) { arrived = ping; });
  cache.wait();
  ASSERT_FALSE(arrived);
  EXPECT_EQ(arrived.error().code, ErrorCode::no_space);
  EXPECT_THAT(to_line(arrived.error()), HasSubstr("not enough memory"));
  cache.look_at(4, [&](const Result<StagedPingPtr>& ping) { arrived = ping; });
  cache.wait();
  EXPECT_TRUE(arrived);
}

TEST(PingCacheJobs, KeepsPingsRoundTheOneLookedAtAndNoneWhereNobodyLooks) {
  const Made made;
  PingCache cache(made.source(), 100, 2);
  ASSERT_TRUE(cache.ping(0));
  EXPECT_FALSE(cache.held(0)) << "nobody looks";
  cache.look_at(50);
  cache.wait();
  const auto held = [&] {
    std::vector<std::int64_t> pings;
    for (std::int64_t i = 0; i < 100; ++i) {
      if (cache.held(i)) pings.push_back(i);
    }
    return pings;
  };
  EXPECT_EQ(held(), (std::vector<std::int64_t>{48, 49, 50, 51, 52}));
  for (std::int64_t i = 0; i < 100; ++i) ASSERT_TRUE(cache.ping(i));
  EXPECT_EQ(held(), (std::vector<std::int64_t>{48, 49, 50, 51, 52}));
  cache.look_at(90);
  cache.wait();
  EXPECT_EQ(held(), (std::vector<std::int64_t>{88, 89, 90, 91, 92}));
  cache.rest();
  EXPECT_TRUE(held().empty());
  cache.keep_last();
  ASSERT_TRUE(cache.ping(7));
  const auto before = made.made->size();
  ASSERT_TRUE(cache.ping(7));
  EXPECT_EQ(made.made->size(), before);
  EXPECT_EQ(held(), (std::vector<std::int64_t>{7}));
}

TEST(DocumentMemory, WhereNotEvenOnePingFitsItIsSaidAndNothingDies) {
  ChangeQueue queue;
  DocumentOptions options = TestSurvey::options(TestSurvey::easy().fresh());
  options.memory_bytes = 1'000'000;
  Document document(queue, options);
  document.open({TestSurvey::easy().folder()});
  document.settle();
  ASSERT_TRUE(document.shown());
  EXPECT_FALSE(document.staged());
  ASSERT_FALSE(document.notices().empty());
  EXPECT_THAT(document.notices().back(), HasSubstr("obs-0001: a ping of "));
  GrowCommand grow;
  grow.seeds = {{0, 100}};
  document.act(grow);
  document.detect({0});
  document.settle();
  EXPECT_THAT(document.choices().failure + document.notices().back(), HasSubstr("memory_gb"));
  EXPECT_TRUE(document.choices().lines->empty());
  // What needs no ping goes on.
  document.act(EventCommand{"trawl", document.shown()->context().times[0], ""});
  document.settle();
  EXPECT_EQ(document.state().events.size(), 1U);
}

TEST(DocumentMemory, FewerPingsAreMadeAheadWhereThereIsLittle) {
  ChangeQueue queue;
  DocumentOptions options = TestSurvey::options(TestSurvey::easy().fresh());
  Document whole(queue, options);
  whole.open({TestSurvey::easy().folder()});
  whole.settle();
  const PingMemory ping = ping_memory(whole.staged()->sv.counts.shape());
  options.memory_bytes = ping.working + 2 * ping.kept;
  Document small(queue, options);
  small.open({TestSurvey::easy().folder()});
  small.settle();
  EXPECT_TRUE(whole.shown()->cache().held(2));
  EXPECT_TRUE(small.shown()->cache().held(1));
  EXPECT_FALSE(small.shown()->cache().held(2));
  // Only the observation on show has its pings in memory.
  ASSERT_TRUE(whole.show(1));
  whole.settle();
  EXPECT_FALSE(whole.open_observation(0)->cache().held(0));
  EXPECT_TRUE(whole.shown()->cache().held(2));
}

}  // namespace
}  // namespace sonar
