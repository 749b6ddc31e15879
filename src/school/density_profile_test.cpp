// SPDX-License-Identifier: Apache-2.0
#include "school/density_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "school/correct_sizes.h"
#include "school/measure.h"
#include "school/test_water.h"

namespace sonar {
namespace {

// Densities of the distance from heart to rim that are not of the family the sizes are told by.
double even(double) { return 1.0; }
double six_decibels(double r) { return 0.5 + 1.5 * std::exp(-4.0 * r * r); }
double exponential(double r) { return std::pow(10.0, -r); }
double hollow(double r) { return r < 0.5 ? 0.0 : 1.0; }

/// Along one axis of a ball of radius 1: variance, and fourth moment over its square.
struct Marginal {
  double variance = 0.0;
  double kurtosis = 0.0;
};
Marginal marginal_of(double (*density)(double)) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  double second = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double u = (i + 0.5) / kSteps;
      const double across = (k + 0.5) / kSteps;
      const double r = std::hypot(u, across);
      if (r > 1.0) continue;
      const double mass = density(r) * across;  // a ring round the axis
      sum += mass;
      second += mass * u * u;
      fourth += mass * u * u * u * u;
    }
  }
  const double variance = second / sum;
  return {variance, fourth / sum / (variance * variance)};
}

TEST(DensityProfile, ExtentsComeOutWhateverTheDensity) {
  EXPECT_NEAR(shape_variance(15.0 / 7.0, 10.0), 5.0, 1e-3);
  for (const auto density : {even, six_decibels, exponential, hollow}) {
    const Marginal m = marginal_of(density);
    const double half_axis = std::sqrt(shape_variance(m.kurtosis, 10.0) * m.variance);
    EXPECT_NEAR(half_axis, 1.0, 0.05) << m.kurtosis;
  }
  EXPECT_LT(std::sqrt(5.0 * marginal_of(six_decibels).variance), 0.93);
}

TEST(DensityProfile, HeartAndRimDifferByNoMoreThanIsBelieved) {
  // without an end a Gaussian's half axis would be infinite; a shell's is sqrt(3) standard deviations
  EXPECT_EQ(shape_variance(3.0, 10.0), shape_variance(2.9, 10.0));
  EXPECT_GT(shape_variance(3.0, 20.0), shape_variance(3.0, 10.0));
  EXPECT_GE(shape_variance(1.8, 30.0), 3.0);
  EXPECT_NEAR(shape_variance(3.0, 0.0), 5.0, 1e-3);
  EXPECT_NEAR(shape_variance(1.8, 0.0), 5.0, 1e-3);
  double before = 0.0;
  for (double kurtosis = 1.8; kurtosis < 2.4; kurtosis += 0.05) {
    EXPECT_GT(shape_variance(kurtosis, 30.0), before);
    before = shape_variance(kurtosis, 30.0);
  }
}

TEST(DensityProfile, FewLooksAndRaggedRimsAreDrawnToAnEvenDensity) {
  MeasureParams params;
  params.density_tolerance = 0.0;
  const double all = shape_variance(2.4, params.density_most_db);
  const double few = shape_variance(std::vector<RangeProfile>{{2.4, 40.0}}, params);
  const double many = shape_variance(std::vector<RangeProfile>{{2.4, 40000.0}, {kUnknown, 1e9}}, params);
  EXPECT_GT(few, 5.0);
  EXPECT_LT(few - 5.0, 0.2 * (all - 5.0));
  EXPECT_NEAR(many, all, 0.05);
  EXPECT_NEAR(shape_variance(std::vector<RangeProfile>{}, params), 5.0, 1e-3);
  params.density_tolerance = 0.1;
  EXPECT_NEAR(shape_variance(std::vector<RangeProfile>{{2.2, 1e9}}, params), 5.0, 1e-3);
  EXPECT_NEAR(shape_variance(std::vector<RangeProfile>{{2.1, 1e9}}, params), 5.0, 1e-3);
  EXPECT_GT(shape_variance(std::vector<RangeProfile>{{2.3, 1e9}}, params), 5.1);
  EXPECT_LT(shape_variance(std::vector<RangeProfile>{{1.9, 1e9}}, params), 4.9);
  MeasureParams off;
  off.find_density = false;
  off.shape_variance = 3.0;
  EXPECT_EQ(shape_variance(std::vector<RangeProfile>{{2.4, 40000.0}}, off), 3.0);
}

/// A body of 40 x 28 x 20 m, 180 m away, measured without fading.
double volume_ratio(double (*density)(double), double pulse_m, const MeasureParams& params) {
  const Shape3 shape{20, 25, 900};
  const BeamGrid grid = test::grid();
  const Sector sector = grid.sector(test::range_axis());
  test::Ellipsoid body;
  body.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(269.0)) * 180.0;
  body.half_x = 14.0;
  body.half_y = 20.0;
  body.half_z = 10.0;
  body.density = density;
  Array3<double> expected(shape);
  test::add_ellipsoid(expected, sector, body, 20'000);
  const Array3<SampleFlags> flags = test::cropped_flags(shape, sector);
  const Array3<std::int16_t> counts = test::counts_of(expected, 1, false);
  const Array3<std::int16_t> filtered = test::filtered(counts, flags);
  const test::FlatBackground flat(shape);
  MeasureInput in;
  in.sv = counts.view();
  in.filtered = filtered.view();
  in.flags = flags.view();
  in.sector = &sector;
  in.grid = &grid;
  in.background = {flat.power_db, flat.calibration.view()};
  in.placement = {.transducer = {60.0, 4.0}, .transducer_depth_m = 7.0};
  in.pulse_m = pulse_m;
  const MeasuredSchool school = measure(in, test::truth_of(expected), params);
  const double body_m3 = 4.0 / 3.0 * std::numbers::pi * body.half_x * body.half_y * body.half_z;
  return correct_sizes({{&school}}, params).front().volume_corrected_m3 / body_m3;
}

TEST(DensityProfile, DenseHeartsAreNoSmallerBodiesAndHollowOnesNoLarger) {
  MeasureParams params;
  params.find_beam_shape = false;
  params.beam_gaussian_share = 1.0;
  params.density_looks = 0.0;
  MeasureParams off = params;
  off.find_density = false;
  for (const auto density : {even, six_decibels, exponential, hollow}) {
    EXPECT_NEAR(volume_ratio(density, 0.0, params), 1.0, 0.15) << marginal_of(density).kurtosis;
  }
  EXPECT_LT(volume_ratio(exponential, 0.0, off), 0.78);
  EXPECT_GT(volume_ratio(hollow, 0.0, off), 1.12);
}

TEST(DensityProfile, WhatIsNoLongerThanThePulseTellsNothing) {
  // every sample as loud as the next, over 1.5 m: a pulse of 2 m leaves no body
  const BeamGrid grid = test::grid();
  const Sector sector = grid.sector(test::range_axis());
  const Shape3 shape{20, 25, 900};
  const Array3<std::int16_t> counts(shape, -6000);
  const Array3<SampleFlags> flags(shape);
  MeasureInput in;
  in.sv = counts.view();
  in.flags = flags.view();
  in.sector = &sector;
  in.grid = &grid;
  PingMask mask;
  mask.runs = {{100, 500, 4}};
  mask.confidence.assign(4, 255);
  const std::vector<double> factors(20, 1.0);
  in.pulse_m = 0.1;
  EXPECT_TRUE(std::isfinite(range_profile(in, mask, factors, MeasureParams{}).kurtosis));
  EXPECT_NEAR(range_profile(in, mask, factors, MeasureParams{}).looks, 4.0, 1e-9);
  in.pulse_m = 2.0;
  EXPECT_TRUE(std::isnan(range_profile(in, mask, factors, MeasureParams{}).kurtosis));
  EXPECT_LT(range_profile(in, mask, factors, MeasureParams{}).looks, 1.0);
  EXPECT_TRUE(std::isnan(range_profile(in, PingMask{}, factors, MeasureParams{}).kurtosis));
}

}  // namespace
}  // namespace sonar
