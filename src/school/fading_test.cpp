// SPDX-License-Identifier: Apache-2.0
#include "school/fading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "school/test_water.h"

namespace sonar {
namespace {

/// By summing: correlation of what two beams hear whose two-way patterns are those of the tests' water.
double summed_correlation(double apart_deg, double width_deg) {
  const double sigma_deg = width_deg / (4.0 * std::sqrt(std::numbers::ln2));  // of the two-way intensity
  double product = 0.0;
  double square = 0.0;
  for (int i = -20000; i <= 20000; ++i) {
    const double z = i * 0.001;
    const double own = test::two_way(test::Beams::gaussian, z, false);
    product += std::sqrt(own * test::two_way(test::Beams::gaussian, z - apart_deg / sigma_deg, false));
    square += own;
  }
  return product / square;
}

TEST(Fading, BeamsShareWhatTheirPatternsDo) {
  BeamGrid grid = test::grid();
  const int row = 10 * 25 + 12;
  const double level = std::cos(grid.elevation_deg[10] * std::numbers::pi / 180.0);
  EXPECT_NEAR(amplitude_correlation(grid, row, row + 1), summed_correlation(2.5 * level, test::kHorizontalWidth_deg),
              1e-6);
  EXPECT_NEAR(amplitude_correlation(grid, row, row - 2), summed_correlation(5.0 * level, test::kHorizontalWidth_deg),
              1e-6);
  EXPECT_NEAR(amplitude_correlation(grid, row, row + 25), summed_correlation(45.0 / 19.0, test::kVerticalWidth_deg),
              1e-6);
  for (int f = 0; f < 20; ++f) grid.frequency_hz[static_cast<std::size_t>(f)] += 2000.0 * f;
  EXPECT_EQ(amplitude_correlation(grid, row, row + 25), 0.0) << "another frequency is another fading";
  EXPECT_EQ(amplitude_correlation(grid, row, row), 1.0);
}

// An omni sonar's beams go all the way round, so each has as many neighbours as any other.
TEST(Fading, ARingOfBeamsHasNoEnds) {
  BeamGrid grid = test::grid();
  const int beams = grid.beams();
  for (int b = 0; b < beams; ++b) grid.azimuth_deg[static_cast<std::size_t>(b)] = 360.0 * b / beams;
  const double width_deg = 360.0 / beams;
  grid.horizontal_width_deg.assign(grid.horizontal_width_deg.size(), width_deg);
  const int row = 10 * beams;
  EXPECT_NEAR(amplitude_correlation(grid, row, row + beams - 1), amplitude_correlation(grid, row, row + 1), 1e-12);
  for (int b = 0; b < beams; ++b) {
    EXPECT_NEAR(voxels_alike_each_way(grid, 0.5, 2.0, row + b).beams, voxels_alike_each_way(grid, 0.5, 2.0, row).beams,
                1e-12);
  }
}

// By hand for a pulse of four samples: 1 + 2 (9/16 + 4/16 + 1/16) = 2.75. Beams far closer than they are wide: as an integral.
TEST(Fading, IsCountedBySquaresOfCorrelations) {
  BeamGrid grid = test::grid();
  EXPECT_NEAR(voxels_alike_each_way(grid, 0.5, 2.0, 262).samples, 2.75, 1e-12);
  EXPECT_EQ(voxels_alike_each_way(grid, 0.5, 0.0, 262).samples, 1.0);
  const double of_integral = std::sqrt(std::numbers::pi / std::numbers::ln2 / 4.0);
  EXPECT_NEAR(voxels_alike_each_way(grid, 0.5, 2.0, 262).fans, of_integral * test::kVerticalWidth_deg / (45.0 / 19.0),
              1e-3);
  for (int f = 0; f < 20; ++f) grid.frequency_hz[static_cast<std::size_t>(f)] += 2000.0 * f;
  EXPECT_EQ(voxels_alike_each_way(grid, 0.5, 2.0, 262).fans, 1.0);
}

// A damaged file may say that a pulse lasts for years, or that samples take no time.
TEST(Fading, OfAbsurdPulsesIsTold) {
  const BeamGrid grid = test::grid();
  const double longest = voxels_alike_each_way(grid, 0.5, 0.5 * kLongestPulse, 262).samples;
  EXPECT_NEAR(longest, 2.0 * kLongestPulse / 3.0, 1.0) << "as an integral";
  for (const double pulse_m : {1e30, std::numeric_limits<double>::infinity()}) {
    for (const double sample_m : {0.5, 1e-300, 0.0}) {
      EXPECT_NEAR(voxels_alike_each_way(grid, sample_m, pulse_m, 262).samples, 2.0 * kLongestPulse, 2.0);
    }
  }
}

// Echo of a rectangular pulse is a running sum of what the targets send back: sums over 48 samples of it scatter by the
// number that is told, less what lies beyond the ends.
TEST(Fading, SumsScatterAsToldAlongRange) {
  constexpr int kPulse = 4;
  constexpr int kSamples = 48;
  constexpr int kLooks = 4000;
  std::uint64_t seed = 1;
  double sum = 0.0;
  double squares = 0.0;
  for (int look = 0; look < kLooks; ++look) {
    std::vector<std::complex<double>> targets(kSamples + kPulse - 1);
    for (auto& one : targets) one = {test::normal(seed), test::normal(seed + 1)}, seed += 2;
    double echo = 0.0;
    for (std::size_t s = 0; s < kSamples; ++s) {
      std::complex<double> amplitude = 0.0;
      for (std::size_t k = 0; k < kPulse; ++k) amplitude += targets[s + k];
      echo += std::norm(amplitude) / (2.0 * kPulse);
    }
    sum += echo / kLooks;
    squares += echo * echo / kLooks;
  }
  const double ends = 2.0 * (9.0 * 1 + 4.0 * 2 + 1.0 * 3) / 16.0;  // pairs that a longer run would have
  const double alike = voxels_alike_each_way(test::grid(), 0.5, 0.5 * kPulse, 262).samples;
  EXPECT_NEAR((squares - sum * sum) / (alike * kSamples - ends), 1.0, 0.1) << "of 4000 a variance is known to 2.5 %";
}

}  // namespace
}  // namespace sonar
