// SPDX-License-Identifier: Apache-2.0
#include "school/measure/fading_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "base/units.h"
#include "school/fading.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr IndexBox kBox{6, 10, 8, 13, 40, 99};
constexpr int kLooks = 120;

/// Mean of the product of voxels that lie so far apart, less 1.
double covariance(const FadingField& field, int fans, int beams, int samples) {
  double sum = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < kLooks; ++seed) {
    const Array3<std::int16_t> counts = field.draw(seed);
    for (int f = 0; f + fans < kBox.fans(); ++f) {
      for (int b = 0; b + beams < kBox.beams(); ++b) {
        for (int s = 0; s + samples < kBox.samples(); ++s) {
          sum += linear_from_count(counts(f, b, s)) * linear_from_count(counts(f + fans, b + beams, s + samples));
          count += 1.0;
        }
      }
    }
  }
  return sum / count - 1.0;
}

// Exponential: the variance is 1. A pulse of four samples by hand: (1 - 1/4)^2. 120 looks at some 300 independent voxels each
// know these within 0.02.
TEST(FadingField, NeighboursFadeAlikeAsBeamsAndPulseOverlap) {
  const BeamGrid grid = test::grid();
  const FadingField field(grid, kBox, 0.5, 2.0);
  const int row = 8 * 25 + 10;
  EXPECT_NEAR(covariance(field, 0, 0, 0), 1.0, 0.08);
  EXPECT_NEAR(covariance(field, 0, 0, 1), 9.0 / 16.0, 0.06);
  EXPECT_NEAR(covariance(field, 0, 0, 4), 0.0, 0.04);
  EXPECT_NEAR(covariance(field, 0, 1, 0), std::pow(amplitude_correlation(grid, row, row + 1), 2), 0.05);
  EXPECT_NEAR(covariance(field, 1, 0, 0), std::pow(amplitude_correlation(grid, row, row + 25), 2), 0.06);
}

TEST(FadingField, FansOfOwnFrequencyFadeByThemselves) {
  BeamGrid grid = test::grid();
  for (std::size_t fan = 0; fan < 20; ++fan) grid.frequency_hz[fan] += 2000.0 * static_cast<double>(fan);
  const FadingField field(grid, kBox, 0.5, 2.0);
  EXPECT_NEAR(covariance(field, 1, 0, 0), 0.0, 0.04);
  EXPECT_EQ(field.draw(3).all()[7], field.draw(3).all()[7]);
  EXPECT_NE(field.draw(3).all()[7], field.draw(4).all()[7]);
}

// Of one that lasts for years neighbouring samples hear the same.
TEST(FadingField, OfAnAbsurdPulseIsDrawn) {
  const Array3<std::int16_t> counts = FadingField(test::grid(), kBox, 0.5, 1e30).draw(1);
  for (int s = 1; s < kBox.samples(); ++s) EXPECT_NEAR(counts(0, 0, s), counts(0, 0, s - 1), counts_from_db(3.0)) << s;
}

}  // namespace
}  // namespace sonar
