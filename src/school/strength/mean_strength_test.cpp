// SPDX-License-Identifier: Apache-2.0
#include "school/strength/mean_strength.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "school/strength/fish_numbers.h"

namespace sonar {
namespace {

FishLengths of_one(double length_cm) { return {{{length_cm, 1.0}}, kUnknown}; }

TsRelation relation(double b_db, double d_db = 0.0) {
  TsRelation r;
  r.b_db = b_db;
  r.d_db = d_db;
  return r;
}

TsRelation line_fish(double heading_sd_deg, double tilt_sd_deg, double any_share) {
  TsRelation r = relation(-68.0);
  r.directivity = {0.25, any_share, heading_sd_deg, tilt_sd_deg};
  return r;
}

// 32 cm herring of Foote's relation have -41.8 dB, and 4.8 of them in a cubic metre make -35 dB.
TEST(MeanStrength, packs_herring_as_a_pocket_calculator_does) {
  const double sigma = MeanStrength(relation(-71.9), of_one(32.0), 400.0).sigma_bs_m2(30.0, {});
  EXPECT_NEAR(db_from_linear(sigma), -41.8, 0.01);
  EXPECT_NEAR(linear_from_db(-35.0) / sigma, 4.8, 0.03);
}

TEST(MeanStrength, falls_with_depth) {
  const MeanStrength ona(relation(-65.4, -2.3), of_one(30.0), 400.0);
  const double ratio = ona.sigma_bs_m2(90.0, {}) / ona.sigma_bs_m2(0.0, {});
  EXPECT_NEAR(db_from_linear(ratio), -2.3, 1e-9);  // log10(1 + 90/10) = 1
  EXPECT_TRUE(std::isnan(ona.sigma_bs_m2(kUnknown, {})));
  EXPECT_FALSE(std::isnan(MeanStrength(relation(-65.4), of_one(30.0), 400.0).sigma_bs_m2(kUnknown, {})));
}

// 10 cm and 40 cm, half each: (100 + 1600) / 2 x 1e-7. Their mean in dB would be 400e-7, and that of the mean length 625e-7.
TEST(MeanStrength, averages_lengths_in_linear_units) {
  const FishLengths lengths{{{10.0, 0.5}, {40.0, 0.5}}, 2.0};
  EXPECT_NEAR(MeanStrength(relation(-70.0), lengths, 400.0).sigma_bs_m2(0.0, {}), 850e-7, 1e-12);
}

TEST(Aspect, is_worked_by_hand) {
  EXPECT_NEAR(aspect_deg({90.0, 0.0, 0.0}), 90.0, 1e-9);
  EXPECT_NEAR(aspect_deg({10.0, 0.0, 190.0}), 0.0, 1e-5);
  EXPECT_NEAR(aspect_deg({30.0, 0.0, 0.0}), 30.0, 1e-9);
  EXPECT_NEAR(aspect_deg({0.0, -30.0, 0.0}), 30.0, 1e-9);
  EXPECT_NEAR(aspect_deg({350.0, -90.0, 80.0}), 90.0, 1e-9);  // from above
  EXPECT_TRUE(std::isnan(aspect_deg({30.0, 0.0, kUnknown})));
}

// All fish alike: (sin x / x)^2 with x = k l cos(aspect), its first null at x = pi.
TEST(MeanStrength, of_fish_that_stand_alike_is_a_line) {
  const double k = 400.0;
  const MeanStrength fish(line_fish(0.0, 0.0, 0.0), of_one(30.0), k);
  const double broadside = linear_from_db(-68.0) * 900.0;
  EXPECT_NEAR(fish.sigma_bs_m2(0.0, {90.0, 0.0, 0.0}), broadside, 1e-9 * broadside);
  const double null_deg = deg_from_rad(std::asin(std::numbers::pi / (k * 0.075)));
  EXPECT_LT(fish.sigma_bs_m2(0.0, {90.0 - null_deg, 0.0, 0.0}), 1e-4 * broadside);
  const double x = k * 0.075 * std::sin(rad_from_deg(3.0));
  EXPECT_NEAR(fish.sigma_bs_m2(0.0, {93.0, 0.0, 0.0}) / broadside, std::pow(std::sin(x) / x, 2), 1e-3);
  const MeanStrength shared(line_fish(0.0, 0.0, 0.1), of_one(30.0), k);
  EXPECT_NEAR(shared.sigma_bs_m2(0.0, {90.0 - null_deg, 0.0, 0.0}) / broadside, 0.1, 1e-3);
}

/// Mean over fish, by vectors and many steps.
double by_vectors(double bearing_deg, double elevation_deg, double heading_sd_deg, double tilt_sd_deg, bool anywhere) {
  constexpr int kSteps = 200;
  const double e = rad_from_deg(elevation_deg);
  const double b = rad_from_deg(bearing_deg);
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = 8.0 * ((i + 0.5) / kSteps - 0.5);
    const double heading = anywhere ? h * std::numbers::pi / 4.0 : h * rad_from_deg(heading_sd_deg);
    for (int j = 0; j < kSteps; ++j) {
      const double t = 8.0 * ((j + 0.5) / kSteps - 0.5);
      const double tilt = t * rad_from_deg(tilt_sd_deg);
      const double dot = std::cos(tilt) * std::sin(heading) * std::sin(b) * std::cos(e) +
                         std::cos(tilt) * std::cos(heading) * std::cos(b) * std::cos(e) + std::sin(tilt) * std::sin(e);
      const double x = 400.0 * 0.075 * dot;
      const double line = std::abs(x) < 1e-9 ? 1.0 : std::pow(std::sin(x) / x, 2);
      const double weight = std::exp(-0.5 * (t * t + (anywhere ? 0.0 : h * h)));
      sum += weight * line;
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(MeanStrength, averages_over_how_fish_stand) {
  const double broadside = linear_from_db(-68.0) * 900.0;
  const MeanStrength fish(line_fish(14.0, 10.0, 0.0), of_one(30.0), 400.0);
  for (const double bearing : {90.0, 70.0, 30.0, 0.0}) {
    for (const double elevation : {0.0, -25.0}) {
      const double expected = by_vectors(bearing, elevation, 14.0, 10.0, false);
      EXPECT_NEAR(fish.sigma_bs_m2(0.0, {bearing, elevation, 0.0}) / broadside, expected, 0.03 * expected)
          << bearing << ' ' << elevation;
    }
  }
  const double any = by_vectors(40.0, -10.0, 0.0, 10.0, true);
  EXPECT_NEAR(fish.sigma_bs_m2(0.0, {40.0, -10.0, kUnknown}) / broadside, any, 0.02 * any);
}

// sigma of 10 and 20 cm is 1 to 4, mean 2.5, so that each lies 60 % off; W = a L^2 is as sigma, and cancels.
TEST(SamplingErrors, are_worked_by_hand) {
  const FishLengths lengths{{{10.0, 0.5}, {20.0, 0.5}}, 100.0};
  const SamplingErrors errors = sampling_errors(lengths, relation(-70.0), {0.01, 2.0});
  EXPECT_NEAR(errors.numbers, 0.6 / std::sqrt(99.0), 1e-12);
  EXPECT_NEAR(errors.biomass, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(sampling_errors({lengths.classes, kUnknown}, relation(-70.0), {}).numbers));
  EXPECT_NEAR(mean_weight_g(lengths, {0.01, 3.0}), 45.0, 1e-12);  // (10 + 80) / 2
}

TEST(Band, holds_errors_and_the_choice_of_strength) {
  const NumberErrors errors{0.03, relative_of_db(0.1737178), kUnknown};  // 0.1737 dB = 4 %
  EXPECT_NEAR(errors.together(), 0.05, 1e-6);
  EXPECT_TRUE(std::isnan(NumberErrors{}.together()));
  const Banded band = banded(100.0, 50.0, 200.0, 0.05);
  EXPECT_NEAR(band.se, 5.0, 1e-12);
  EXPECT_NEAR(band.low, 50.0 / std::exp(1.96 * 0.05), 1e-3);
  EXPECT_NEAR(band.high, 200.0 * std::exp(1.96 * 0.05), 1e-3);
  const Banded without = banded(100.0, 50.0, 200.0, kUnknown);
  EXPECT_EQ(without.low, 50.0);
  EXPECT_TRUE(std::isnan(without.se));
}

}  // namespace
}  // namespace sonar
