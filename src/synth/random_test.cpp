// SPDX-License-Identifier: Apache-2.0
#include "synth/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.h"
#include "synth/speckle.h"

namespace sonar::synth {
namespace {

TEST(Philox, AgreesWithItsAuthorsKnownAnswers) {
  // kat_vectors of the Random123 distribution, philox4x32 10.
  EXPECT_THAT(philox({0, 0, 0, 0}, {0, 0}), testing::ElementsAre(0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U));
  EXPECT_THAT(philox({0xffffffffU, 0xffffffffU, 0xffffffffU, 0xffffffffU}, {0xffffffffU, 0xffffffffU}),
              testing::ElementsAre(0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU));
}

TEST(RandomStream, DiffersByEveryPartOfItsKey) {
  const auto first = [](RandomStream s) { return s.block(); };
  const auto base = first({1, Purpose::body, 2, 3, 4});
  EXPECT_EQ(base, first({1, Purpose::body, 2, 3, 4}));
  EXPECT_NE(base, first({2, Purpose::body, 2, 3, 4}));
  EXPECT_NE(base, first({1, Purpose::interference, 2, 3, 4}));
  EXPECT_NE(base, first({1, Purpose::body, 3, 3, 4}));
  EXPECT_NE(base, first({1, Purpose::body, 2, 4, 4}));
  EXPECT_NE(base, first({1, Purpose::body, 2, 3, 5}));
}

TEST(RandomStream, HasTheMomentsItShould) {
  RandomStream random(7, Purpose::body);
  constexpr int kDraws = 100'000;
  double normal = 0.0;
  double squared = 0.0;
  double events = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    normal += x;
    squared += x * x;
    events += random.poisson(2.5);
  }
  EXPECT_NEAR(normal / kDraws, 0.0, 0.015);
  EXPECT_NEAR(squared / kDraws, 1.0, 0.03);
  EXPECT_NEAR(events / kDraws, 2.5, 0.03);
}

TEST(Speckle, IsExponentialAboutTheExpectedPower) {
  for (const double correlation : {0.0, 0.5}) {
    constexpr double kPower = 1e-16;
    const std::vector<float> expected(400'000, static_cast<float>(kPower));
    std::vector<std::int16_t> counts(expected.size());
    speckled_counts(expected, correlation, RandomStream(3, Purpose::speckle), counts);
    double sum = 0.0;
    double lag = 0.0;
    int below_median = 0;
    double before = 1.0;
    for (const std::int16_t count : counts) {
      const double power = linear_from_db(db_from_counts(count)) / kPower;
      sum += power;
      lag += (power - 1.0) * (before - 1.0);
      before = power;
      below_median += power < std::log(2.0) ? 1 : 0;  // the median of an exponential of mean 1
    }
    const auto n = static_cast<double>(counts.size());
    EXPECT_NEAR(sum / n, 1.0, 0.01);
    EXPECT_NEAR(below_median / n, 0.5, 0.005);
    EXPECT_NEAR(lag / n, correlation * correlation, 0.02);  // of the power: the square of the amplitude's
  }
}

TEST(Speckle, CountsAreTheNearestOnes) {
  EXPECT_EQ(count_of_power(1.0), 0);
  EXPECT_EQ(count_of_power(0.5), -256);
  EXPECT_EQ(count_of_power(1e-13), -11055);  // -130 dB / 0.0117589842
  EXPECT_EQ(count_of_power(0.0), kMinCount);
}

}  // namespace
}  // namespace sonar::synth
