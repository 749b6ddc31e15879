// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/named_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "base/work.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(NamedLock, TellsWhoHoldsIt) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "locks" / "a.lock";
  EXPECT_EQ(NamedLock::holder(file), "");
  NamedLock first;
  ASSERT_EQ(first.take(file, "anna", test::kStart)->held_by, "");
  NamedLock second;
  EXPECT_THAT(second.take(file, "bent", test::kStart)->held_by, HasSubstr("anna (host "));
  EXPECT_THAT(second.take(file, "bent", test::kStart)->held_by, HasSubstr("since 2020-01-01T00:00:00.000Z"));
  EXPECT_FALSE(second.held());
  EXPECT_THAT(NamedLock::holder(file), HasSubstr("anna (host "));
  first.let_go();
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(second.take(file, "bent", test::kStart)->held_by, "");
}

// Whoever looks at a lock that is just being made, or just let go of, must not take it for one that was left behind.
TEST(NamedLock, NoTwoThreadsHoldItAtOnce) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "locks" / "a.lock";
  std::atomic<int> holders = 0;
  std::atomic<int> most = 0;
  std::atomic<int> times = 0;
  Work work(8);
  work.for_each(2000, [&](std::int64_t) {
    NamedLock lock;
    const auto taken = lock.take(file, "somebody", 0);
    if (!taken) return;
    EXPECT_EQ(lock.held(), taken->held_by.empty());
    if (!lock.held()) return;
    EXPECT_EQ(taken->notice, "") << "it is nobody's that has ended";
    const int now = ++holders;
    if (now > most) most = now;
    ++times;
    --holders;
  });
  EXPECT_EQ(most, 1);
  EXPECT_GT(times, 10);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace sonar
