// SPDX-License-Identifier: Apache-2.0
#include "base/work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sonar {
namespace {

TEST(Work, EveryIndexExactlyOnce) {
  for (const int threads : {1, 2, 5}) {
    Work work(threads);
    EXPECT_EQ(work.threads(), threads);
    for (const std::int64_t count : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> seen(static_cast<std::size_t>(count));
      work.for_each(count, [&](std::int64_t i) { ++seen[static_cast<std::size_t>(i)]; });
      EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](const auto& n) { return n == 1; })) << threads;
    }
  }
}

TEST(Work, ZeroThreadsMeansWhatTheMachineHas) { EXPECT_GE(Work(0).threads(), 1); }

TEST(Work, NestedWorkIsDoneToo) {
  Work work(3);
  std::atomic<std::int64_t> sum{0};
  work.for_each(20, [&](std::int64_t i) { work.for_each(30, [&](std::int64_t k) { sum += 100 * i + k; }); });
  // 30 * 100 * (0 + .. + 19) + 20 * (0 + .. + 29)
  EXPECT_EQ(sum, 30 * 100 * 190 + 20 * 435);
}

TEST(Work, CancelStopsEarly) {
  Work work(1);
  std::atomic<int> done{0};
  work.for_each(1000, [&](std::int64_t) {
    if (++done == 10) work.cancel();
  });
  EXPECT_TRUE(work.cancelled());
  EXPECT_EQ(done, 10);
  work.for_each(1000, [&](std::int64_t) { ++done; });
  EXPECT_EQ(done, 10);
}

TEST(Work, CancelOnSeveralThreadsLeavesMostUndone) {
  Work work(4);
  std::atomic<int> done{0};
  work.for_each(100000, [&](std::int64_t) {
    ++done;
    work.cancel();
  });
  EXPECT_TRUE(work.cancelled());
  EXPECT_LE(done, 4);
}

TEST(Work, ExceptionReachesTheCaller) {
  for (const int threads : {1, 4}) {
    Work work(threads);
    try {
      work.for_each(100, [](std::int64_t i) {
        if (i == 42) throw std::runtime_error("forty-two");
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "forty-two");
    }
    // The pool is sound afterwards.
    std::atomic<int> done{0};
    work.for_each(50, [&](std::int64_t) { ++done; });
    EXPECT_EQ(done, 50);
  }
}

TEST(Work, ProgressComesOneCallAtATime) {
  Work work(4);
  int inside = 0;  // plain on purpose: the sink is called under one lock
  std::int64_t calls = 0;
  bool overlapped = false;
  work.set_progress([&](std::string_view stage, std::int64_t, std::int64_t total) {
    overlapped = overlapped || ++inside != 1 || stage != "test" || total != 500;
    ++calls;
    --inside;
  });
  work.for_each(500, [&](std::int64_t i) { work.progress("test", i, 500); });
  EXPECT_EQ(calls, 500);
  EXPECT_FALSE(overlapped);
  work.set_progress({});
  work.progress("nowhere", 1, 2);
  EXPECT_EQ(calls, 500);
}

}  // namespace
}  // namespace sonar
