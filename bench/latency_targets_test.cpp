// SPDX-License-Identifier: Apache-2.0
#include "latency_targets.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace sonar::bench {
namespace {

bool says(const std::string& line, const std::string& words) { return line.find(words) != std::string::npos; }

// Of 1, 2, 30 the median is 2: a slow one among many misses nothing, a median at the target does.
TEST(LatencyTargets, TheMedianIsBelowTheTargetOrItIsMissed) {
  LatencyTargets targets(true);
  EXPECT_TRUE(says(targets.line("hover", {30.0, 2.0, 1.0}, 10.0), "target 10 ms: met"));
  EXPECT_EQ(targets.exit_code(), 0);
  EXPECT_EQ(targets.verdict(), "all 1 targets met");
  EXPECT_TRUE(says(targets.line("slice", {16.0, 16.0, 1.0}, 16.0), "target 16 ms: MISSED"));
  EXPECT_FALSE(says(targets.line("at rest", {900.0}, std::nullopt), "target"));
  EXPECT_EQ(targets.verdict(), "MISSED 1 of 2 targets: slice");
  EXPECT_EQ(targets.exit_code(), 1);
}

TEST(LatencyTargets, NothingFailsUnlessItIsChecked) {
  LatencyTargets targets(false);
  EXPECT_TRUE(says(targets.line("slice", {17.0}, 16.0), "MISSED"));
  EXPECT_EQ(targets.exit_code(), 0);
}

TEST(LatencyTargets, CheckStandsAnywhere) {
  std::string program = "bench";
  std::string first = "5";
  std::string check = "--check";
  std::string second = "survey";
  std::array<char*, 4> words{program.data(), first.data(), check.data(), second.data()};
  const LatencyArguments given = latency_arguments(4, words.data());
  EXPECT_TRUE(given.check);
  EXPECT_EQ(given.others, (std::vector<std::string>{"5", "survey"}));
}

}  // namespace
}  // namespace sonar::bench
