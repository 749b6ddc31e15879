// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/stratified_mean.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sonar {
namespace {

TEST(StratifiedMean, of_equal_transects_is_the_plain_mean_and_its_standard_error) {
  // Of 1, 2, 6: mean 3, variance (4 + 1 + 9) / 2 = 7, its error sqrt(7 / 3).
  const std::array<WeightedValue, 3> transects{{{5.0, 1.0}, {5.0, 2.0}, {5.0, 6.0}}};
  const MeanWithError mean = transect_mean(transects);
  EXPECT_NEAR(mean.mean, 3.0, 1e-12);
  EXPECT_NEAR(mean.se, std::sqrt(7.0 / 3.0), 1e-12);
}

TEST(StratifiedMean, longer_transects_count_more) {
  // By hand: weights 1/4, 3/4; mean 0.25 * 8 + 0.75 * 4 = 5; 2/1 * (0.0625 * 9 + 0.5625 * 1) = 2.25.
  const std::array<WeightedValue, 2> transects{{{1.0, 8.0}, {3.0, 4.0}}};
  const MeanWithError mean = transect_mean(transects);
  EXPECT_NEAR(mean.mean, 5.0, 1e-12);
  EXPECT_NEAR(mean.se, 1.5, 1e-12);
}

TEST(StratifiedMean, one_transect_tells_no_error_and_an_unknown_one_nothing) {
  const std::array<WeightedValue, 3> transects{{{2.0, 7.0}, {1.0, kUnknown}, {0.0, 100.0}}};
  const MeanWithError mean = transect_mean(transects);
  EXPECT_EQ(mean.mean, 7.0);
  EXPECT_TRUE(std::isnan(mean.se));
  EXPECT_TRUE(std::isnan(transect_mean({}).mean));
}

TEST(StratifiedMean, strata_add_up_by_their_weights) {
  // By hand: (1 * 2 + 3 * 6) / 4 = 5; sqrt(1 * 9 + 9 * 1.777...) / 4 = 5 / 4.
  const std::array<WeightedMean, 2> strata{{{1.0, {2.0, 3.0}}, {3.0, {6.0, 4.0 / 3.0}}}};
  EXPECT_NEAR(stratified_mean(strata).mean, 5.0, 1e-12);
  EXPECT_NEAR(stratified_mean(strata).se, 1.25, 1e-12);
  const std::array<WeightedMean, 2> one_alone{{{1.0, {2.0, 3.0}}, {3.0, {6.0, kUnknown}}}};
  EXPECT_TRUE(std::isnan(stratified_mean(one_alone).se));
}

}  // namespace
}  // namespace sonar
