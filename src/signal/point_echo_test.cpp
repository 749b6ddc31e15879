// SPDX-License-Identifier: Apache-2.0
#include "signal/point_echo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr double kPulse = 4.0;  // samples
constexpr int kHalf = 5;

/// A rectangular pulse through its matched filter: amplitude 1 - |t| / pulse, so 20 log10 of it, top 1 W.
double triangle_w(double off) {
  const double amplitude = std::max(0.0, 1.0 - std::abs(off) / kPulse);
  return amplitude * amplitude;
}

std::vector<std::int16_t> row(double centre, double top_w, double noise_w) {
  std::vector<std::int16_t> counts;
  for (int i = 0; i < 60; ++i) counts.push_back(count_from_linear(top_w * triangle_w(i - centre) + noise_w));
  return counts;
}

TEST(PointEcho, TheSumDoesNotDependOnWhereBetweenSamplesTheEchoLies) {
  // Integral of the squared triangle by hand: 2 * pulse / 3. Its samples' sum is 2.75 to 2.625, 0.13 dB either way.
  for (const double centre : {30.0, 30.25, 30.5, 30.8}) {
    const PointEcho echo = point_echo(row(centre, 1e-9, 1e-16), 30, kHalf);
    EXPECT_NEAR(db_from_linear(echo.sum_w / 1e-9), db_from_linear(2.0 * kPulse / 3.0), 0.14) << centre;
    EXPECT_NEAR(echo.centre_sample, centre, 0.05) << centre;
  }
}

TEST(PointEcho, SteadyNoiseIsTakenOff) {
  // A constant has its median as its mean times ln 2 of an exponential: only the ratio is known beforehand.
  const PointEcho quiet = point_echo(row(30.0, 1e-9, 1e-20), 30, kHalf);
  const PointEcho noisy = point_echo(row(30.0, 1e-9, 1e-12), 30, kHalf);
  EXPECT_NEAR(db_from_linear(noisy.sum_w / quiet.sum_w), 0.0, 0.02);
  EXPECT_NEAR(noisy.noise_w, 1e-12 / std::log(2.0), 1e-14);
}

TEST(PointEcho, NothingWhereTheWindowRunsOverAnEnd) {
  const auto counts = row(2.0, 1e-9, 1e-16);
  EXPECT_FALSE(point_echo(counts, 2, kHalf).sum_w > 0.0);
  EXPECT_FALSE(point_echo(counts, 57, kHalf).sum_w > 0.0);
}

TEST(EchoTops, TheTopIsFoundFromSamplesThatMissIt) {
  // 10 log10(top / sum) of the triangle's samples is -10 log10(2.75), by hand; two groups, of which one has less of a top.
  std::vector<OffTop> echoes;
  for (int i = 0; i < 40; ++i) {
    const double centre = 30.0 + 0.025 * i;
    const PointEcho echo = point_echo(row(centre, 1e-9, 1e-20), 30 + (i > 20 ? 1 : 0), kHalf);
    const double off = std::round(echo.centre_sample) - echo.centre_sample;
    echoes.push_back(
        {i % 2 == 0 ? std::size_t{0} : std::size_t{1}, off, echo.nearest_share_db - (i % 2 == 0 ? 0.0 : 0.3)});
  }
  const auto tops = echo_tops(echoes, 3);
  EXPECT_NEAR(tops[0].share_db, -db_from_linear(2.75), 0.06);
  EXPECT_NEAR(tops[1].share_db, -db_from_linear(2.75) - 0.3, 0.06);
  EXPECT_EQ(tops[2].echoes, 0);
  EXPECT_EQ(tops[0].echoes, 20);
}

TEST(EchoTops, OfNoEchoesNothingIsKnown) {
  for (const EchoTop& top : echo_tops({}, 3)) EXPECT_EQ(top.echoes, 0);
}

}  // namespace
}  // namespace sonar
