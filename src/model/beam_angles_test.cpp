// SPDX-License-Identifier: Apache-2.0
#include "model/beam_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Fans 0 and 19, beam 12, of a recorded MS70.
BeamGrid two_fans() {
  BeamGrid grid;
  grid.elevation_deg = {-45.0, 0.0};
  grid.azimuth_deg = {270.0};
  grid.vertical_width_deg = {6.994, 7.235};
  grid.horizontal_width_deg = {2.709, 3.963};
  grid.psi_stated_db = {-18.83, -22.67};
  return grid;
}

// By hand: 10 log10(6.994 x 2.709 x (pi/180)^2) = -22.387, the square of a Gaussian 10 log10(pi / (8 ln 2)) = -2.468.
TEST(BeamAngles, FollowFromTheWidths) {
  EXPECT_NEAR(psi_from_widths_db(6.994, 2.709), -24.855, 0.001);
  EXPECT_TRUE(std::isnan(psi_from_widths_db(0.0, 2.709))) << "not filled in";
  EXPECT_TRUE(std::isnan(psi_from_widths_db(6.994, kNaN)));
}

// A one-way Gaussian beam of -3 dB width w is exp(-4 ln 2 (x/w)^2); the square summed over a plane of small angles.
TEST(BeamAngles, AreTheIntegralOfTheSquare) {
  const double w = 0.1;
  double sum = 0.0;
  for (int i = -300; i < 300; ++i) {
    for (int j = -300; j < 300; ++j) {
      const double r2 = ((i + 0.5) * (i + 0.5) + (j + 0.5) * (j + 0.5)) * 1e-6;
      sum += std::exp(-8.0 * std::log(2.0) * r2 / (w * w)) * 1e-6;
    }
  }
  EXPECT_NEAR(sum / (w * w), kSquareBeamArea, 1e-4);
}

// -18.83 + 24.855, and by hand for the other: widths -20.592 dB, hence -23.060.
TEST(BeamAngles, TellHowMuchTheStatedOnesExceedThem) {
  const std::vector<double> excess = psi_excess_db(two_fans());
  ASSERT_EQ(excess.size(), 2U);
  EXPECT_NEAR(excess[0], 6.025, 0.001);
  EXPECT_NEAR(excess[1], 0.39, 0.01);
  const PsiExcess all = excess_over(excess);
  EXPECT_EQ(all.beams, 2U);
  EXPECT_EQ(all.impossible, 1U) << "3.5 dB is the most that a wide transmit beam makes of it";
  EXPECT_DOUBLE_EQ(all.least_db, excess[1]);
  EXPECT_DOUBLE_EQ(all.most_db, excess[0]);
  EXPECT_NEAR(all.mean_db, 4.065, 0.01);  // 10 log10((4.004 + 1.094) / 2)
  EXPECT_NEAR(excess_of_fan(excess, two_fans(), 1).mean_db, 0.39, 0.01);
  EXPECT_EQ(text_of(all),
            "psi is 0.4 to 6.0 dB (mean 4.1) more than the widths give; in 1 of 2 beams no transmit beam explains it");
}

TEST(BeamAngles, LeaveOutWhatIsNotKnown) {
  BeamGrid grid = two_fans();
  grid.psi_stated_db = {};
  EXPECT_EQ(excess_over(psi_excess_db(grid)).beams, 0U);
  EXPECT_EQ(text_of(excess_over(psi_excess_db(grid))), "");
  grid.psi_stated_db = {kNaN, -25.0};
  const PsiExcess some = excess_over(psi_excess_db(grid));
  EXPECT_EQ(some.beams, 1U);
  EXPECT_EQ(some.impossible, 1U) << "narrower than the square of its own widths";
}

}  // namespace
}  // namespace sonar
