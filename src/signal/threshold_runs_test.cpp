// SPDX-License-Identifier: Apache-2.0
#include "signal/threshold_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/units.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

std::vector<SampleRun> plain_runs(const std::vector<std::int16_t>& counts, const std::vector<std::int16_t>& limit) {
  std::vector<SampleRun> runs;
  bool open = false;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool inside = counts[i] != kNoData && limit[i] != kNoData && counts[i] >= limit[i];
    if (inside && !open) runs.push_back({static_cast<std::int32_t>(i), 0});
    if (inside) ++runs.back().count;
    open = inside;
  }
  return runs;
}

TEST(runs, by_hand) {
  const std::vector<std::int16_t> counts = {5, 1, 7, 7, kNoData, 7, 2, 9};
  std::vector<SampleRun> runs = {{100, 3}};
  append_runs(counts, 5, runs);
  EXPECT_THAT(runs, testing::ElementsAre(SampleRun{100, 3}, SampleRun{0, 1}, SampleRun{2, 2}, SampleRun{5, 1},
                                         SampleRun{7, 1}));
}

TEST(runs, equal_to_a_plain_scan_for_all_lengths) {
  TestRandom random(3);
  for (const int size : {0, 1, 2, 15, 16, 17, 63, 64, 65, 127, 128, 129, 1319, 2047, 2048, 2049, 5000}) {
    for (const int spread : {2, 20, 60000}) {
      std::vector<std::int16_t> counts(static_cast<std::size_t>(size));
      std::vector<std::int16_t> limit(counts.size());
      for (auto& v : counts)
        v = random.below(10) == 0 ? kNoData : static_cast<std::int16_t>(random.below(spread) - spread / 2);
      for (auto& v : limit)
        v = random.below(50) == 0 ? kNoData : static_cast<std::int16_t>(random.below(spread) - spread / 2);
      std::vector<SampleRun> one;
      append_runs(counts, std::int16_t{0}, one);
      EXPECT_EQ(one, plain_runs(counts, std::vector<std::int16_t>(counts.size(), 0))) << size;
      std::vector<SampleRun> each;
      append_runs(counts, limit, each);
      EXPECT_EQ(each, plain_runs(counts, limit)) << size;
    }
  }
}

TEST(runs, one_long_run) {
  std::vector<SampleRun> runs;
  append_runs(std::vector<std::int16_t>(9000, 3), std::int16_t{3}, runs);
  EXPECT_THAT(runs, testing::ElementsAre(SampleRun{0, 9000}));
  runs.clear();
  append_runs(std::vector<std::int16_t>(2, kMinCount), kNoData, runs);
  EXPECT_THAT(runs, testing::ElementsAre(SampleRun{0, 2}));
}

}  // namespace
}  // namespace sonar
