// SPDX-License-Identifier: Apache-2.0
#include "signal/beam_overlap.h"

#include <gtest/gtest.h>

#include <limits>

namespace sonar {
namespace {

TEST(BeamOverlap, LossIsThatOfAGaussianLobe) {
  // half a width off axis: -3 dB each way
  EXPECT_NEAR(neighbour_loss_db(1.0, 2.0), 6.0, 1e-12);
  EXPECT_NEAR(neighbour_loss_db(4.0, 4.0), 24.0, 1e-12);
  EXPECT_EQ(neighbour_loss_db(4.0, 0.0), 0.0);
  EXPECT_EQ(neighbour_loss_db(std::numeric_limits<double>::infinity(), 4.0), 0.0);
  EXPECT_EQ(neighbour_loss_db(4.0, std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_EQ(neighbour_loss_db(4.0, 1e-9), 60.0);
}

TEST(BeamOverlap, BoxShrinksOnlyWhereBeamsAreSeparateBothWays) {
  const std::vector<double> elevation{-8.0, -4.0, 0.0};
  const std::vector<double> azimuth{-4.0, 0.0, 4.0};
  const std::vector<double> narrow(9, 4.5);
  const std::vector<double> wide(9, 7.0);
  const MedianParams box;
  EXPECT_EQ(fitted(box, elevation, azimuth, narrow, narrow).kernel_fans, 1);
  EXPECT_EQ(fitted(box, elevation, azimuth, narrow, narrow).kernel_beams, 1);
  EXPECT_EQ(fitted(box, elevation, azimuth, narrow, narrow).kernel_samples, box.kernel_samples);
  EXPECT_EQ(fitted(box, elevation, azimuth, wide, narrow).kernel_beams, 3);
  EXPECT_EQ(fitted(box, elevation, azimuth, narrow, wide).kernel_fans, 3);
  EXPECT_EQ(fitted(box, elevation, azimuth, {}, narrow).kernel_fans, 3);
}

}  // namespace
}  // namespace sonar
