// SPDX-License-Identifier: Apache-2.0
#include "school/measure/echo_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "school/test_ping.h"

namespace sonar {
namespace {

/// One beam's run, so that all volumes are nearly alike.
struct Stretch : test::MeasuredPing {
  explicit Stretch(int samples) {
    mask.runs = {{262, 600, samples}};
    mask.confidence.assign(static_cast<std::size_t>(samples), 255);
  }
  void level(int first, int end, double sv) {
    for (int s = first; s < end; ++s) expected.view().row(262)[static_cast<std::size_t>(600 + s)] = sv;
  }
  EchoSpread spread(std::uint64_t seed, bool speckle, const std::vector<sonar::Run>& core = {}) {
    if (counts.shape().size() == 0) counts = Array3<std::int16_t>(expected.shape());
    const auto heard = counts.view().row(262);
    for (std::size_t s = 0; s < heard.size(); ++s) {
      const double fading = speckle ? -std::log(test::uniform(seed * 0x100000001ULL + s)) : 1.0;
      const double sv = (expected.view().row(262)[s] + linear_from_db(test::kNoise_db)) * fading;
      heard[s] = static_cast<std::int16_t>(std::lround(counts_from_db(db_from_linear(sv))));
    }
    MeasureInput in;
    in.sv = counts.view();
    in.flags = flags.view();
    in.sector = &sector;
    in.grid = &grid;
    in.background = {flat.power_db, flat.calibration.view()};
    return echo_spread(in, mask, core);
  }
};

// Two levels, 3 to 1 in volume, by hand: mean 2, deviations -1 (3/4) and 3 (1/4) of level 1 and 5:
// variance 3, third moment 3/4 (-1) + 1/4 27 = 6, fourth 3/4 + 81/4 = 21.
TEST(EchoSpread, MomentsOfTwoLevelsByHand) {
  Stretch stretch(4);
  stretch.level(0, 3, 1e-4);
  stretch.level(3, 4, 5e-4);
  const EchoSpread spread = stretch.spread(1, false);
  EXPECT_NEAR(spread.variation, std::sqrt(3.0) / 2.0, 0.005);
  EXPECT_NEAR(spread.skewness, 6.0 / std::pow(3.0, 1.5), 0.02);
  EXPECT_NEAR(spread.kurtosis, 21.0 / 9.0 - 3.0, 0.03);
}

TEST(EchoSpread, FadingAloneHasTheMomentsOfAnExponential) {
  double variation = 0.0;
  double skewness = 0.0;
  double kurtosis = 0.0;
  double robust_db = 0.0;
  constexpr int kTimes = 200;
  Stretch stretch(290);
  stretch.level(0, 290, 1e-4);
  for (int i = 1; i <= kTimes; ++i) {
    const EchoSpread spread = stretch.spread(static_cast<std::uint64_t>(i), true);
    variation += spread.variation / kTimes;
    skewness += spread.skewness / kTimes;
    kurtosis += spread.kurtosis / kTimes;
    robust_db += spread.robust_mean_db / kTimes;
  }
  EXPECT_NEAR(variation, 1.0, 0.02);
  EXPECT_NEAR(skewness, 2.0, 0.2) << "a little less by 290 samples";
  EXPECT_NEAR(kurtosis, 6.0, 1.5);
  EXPECT_NEAR(robust_db, -40.0, 0.1) << "no lower than the mean for what is cut off";
}

// 12 of 290 samples, a thousand times as strong: the mean is 16 dB too high.
TEST(EchoSpread, TheRobustMeanBearsAFewLoudSamples) {
  Stretch stretch(290);
  stretch.level(0, 290, 1e-4);
  const double clean = stretch.spread(3, true).robust_mean_db;
  stretch.level(100, 112, 1e-1);
  EXPECT_NEAR(stretch.spread(3, true).robust_mean_db, clean, 1.0);
}

TEST(EchoSpread, CoreAndEdge) {
  Stretch stretch(100);
  stretch.level(0, 100, 1e-5);
  stretch.level(20, 80, 1e-4);
  EXPECT_NEAR(stretch.spread(1, false, {{262, 620, 60}}).core_edge_db, 10.0, 0.02);
  EXPECT_TRUE(std::isnan(stretch.spread(1, false).core_edge_db)) << "no core";
  EXPECT_TRUE(std::isnan(stretch.spread(1, false, stretch.mask.runs).core_edge_db)) << "nothing but core";
}

// Two thin lumps of 1 and 3 parts of echo, 60 samples apart: three quarters of the way from the weaker.
TEST(EchoSpread, TheCentreOfMassIsDrawnByTheEcho) {
  Stretch stretch(61);
  stretch.level(0, 1, 1e-4);
  stretch.level(60, 61, 3e-4);
  const EchoSpread spread = stretch.spread(1, false);
  ASSERT_TRUE(spread.centre);
  const RangeAxis& axis = stretch.sector.range();
  const double near_v = stretch.sector.volume_m3(10, 12, 600);
  const double far_v = 3.0 * stretch.sector.volume_m3(10, 12, 660);
  const double expected = (near_v * axis.range_m(600) + far_v * axis.range_m(660)) / (near_v + far_v);
  EXPECT_NEAR(norm(*spread.centre), expected, 0.05);
}

TEST(EchoSpread, WithoutEchoAboveTheBackgroundNothingIsKnown) {
  Stretch stretch(50);
  for (SampleFlags& flag : stretch.flags.view().row(262)) flag |= SampleFlags::corrupted;
  const EchoSpread spread = stretch.spread(1, true);
  EXPECT_TRUE(std::isnan(spread.variation));
  EXPECT_TRUE(std::isnan(spread.robust_mean_db));
  EXPECT_FALSE(spread.centre);
}

}  // namespace
}  // namespace sonar
