// SPDX-License-Identifier: Apache-2.0
#include "signal/noise_beside_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sonar {
namespace {

/// Twelve blocks, each two and a half times as far above the power as the one before.
std::vector<double> gains() {
  std::vector<double> gain;
  for (int k = 0; k < 12; ++k) gain.push_back(std::pow(2.5, k));
  return gain;
}

std::vector<double> levels(double water, double noise) {
  std::vector<double> sv;
  for (const double gain : gains()) sv.push_back(water + noise * gain);
  return sv;
}

// Levels that water and noise made without scatter give the water back; and three quarters of them less one may hold more.
TEST(noise_beside_water, water_is_told_from_noise_and_from_what_adds_to_both) {
  EXPECT_NEAR(uniform_water_sv(levels(3.0, 0.01), gains()), 3.0, 1e-9);
  EXPECT_NEAR(uniform_water_sv(levels(0.0, 0.01), gains()), 0.0, 1e-9);
  EXPECT_NEAR(uniform_water_sv(levels(3.0, 0.0), gains()), 3.0, 1e-9);
  std::vector<double> sv = levels(3.0, 0.01);
  for (const std::size_t school : {1U, 4U, 5U, 8U, 9U}) sv[school] *= 20.0;
  EXPECT_NEAR(uniform_water_sv(sv, gains()), 3.0, 1e-9);
}

TEST(noise_beside_water, scales_with_units) {
  std::vector<double> sv = levels(3.0, 0.01);
  sv[3] *= 1.7;
  sv[7] *= 0.8;
  const double water = uniform_water_sv(sv, gains());
  for (double& level : sv) level *= 1e-9;
  EXPECT_NEAR(uniform_water_sv(sv, gains()) / 1e-9, water, 1e-9 * water);
}

TEST(noise_beside_water, too_few_levels_hold_no_water) {
  EXPECT_EQ(uniform_water_sv({}, {}), 0.0);
  EXPECT_EQ(uniform_water_sv(std::vector{2.0}, std::vector{1.0}), 0.0);
}

// By hand: equal weights, power less water 1, 2, .. 8: the second is the first that a quarter lies at or below; where the spread is
// 0.1 and the softest level usually 2, the quartile lies 0.674 x 0.1 x 2 low.
TEST(noise_beside_water, quartile_of_what_is_left_by_hand) {
  std::vector<double> power;
  std::vector<double> water;
  for (int k = 0; k < 8; ++k) {
    power.push_back(10.0 + (5 * k) % 8 + 1);
    water.push_back(10.0);
  }
  const std::vector<double> usual(8, 2.0);
  EXPECT_NEAR(noise_beside_water(power, water, usual, 0.0), 2.0, 1e-12);
  EXPECT_NEAR(noise_beside_water(power, water, usual, 0.1), 2.0 + 0.674 * 0.2, 1e-12);
  water.assign(8, 100.0);  // more water than was heard: no noise can be told, and a level has a logarithm
  EXPECT_NEAR(noise_beside_water(power, water, usual, 0.1), 0.2, 1e-12);
}

}  // namespace
}  // namespace sonar
