// SPDX-License-Identifier: Apache-2.0
#include "school/measure/density_profile.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/measure/correct_sizes.h"
#include "school/measure/measure.h"
#include "school/test_water.h"

namespace sonar {
namespace {

// Densities of the distance from core to margin that are not of the family the sizes are told by.
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
  EXPECT_NEAR(shape_variance(15.0 / 7.0), 5.0, 1e-12);
  for (const auto density : {even, six_decibels, exponential, hollow}) {
    const Marginal m = marginal_of(density);
    EXPECT_NEAR(std::sqrt(shape_variance(m.kurtosis) * m.variance), 1.0, 0.05) << m.kurtosis;
  }
  EXPECT_LT(std::sqrt(5.0 * marginal_of(six_decibels).variance), 0.93);
}

// By hand: kurtosis, and square of the half length over the variance, of what is spread evenly along a line, round a hoop
// and over a shell; of two lumps.
TEST(DensityProfile, LinesHoopsShellsAndLumpsAreAsLongAsTheyAre) {
  for (const auto& [kurtosis, shape] : {std::pair{9.0 / 5.0, 3.0}, {3.0 / 2.0, 2.0}, {1.0, 1.0}}) {
    EXPECT_NEAR(std::sqrt(shape_variance(kurtosis) / shape), 1.0, 0.085) << kurtosis;
  }
}

TEST(DensityProfile, CoreAndMarginDifferByNoMoreThanIsBelieved) {
  EXPECT_EQ(shape_variance(3.0), shape_variance(2.9));  // without an end a Gaussian's half axis would be infinite
  EXPECT_EQ(shape_variance(0.2), shape_variance(1.0));  // nothing has less
  double before = 0.0;
  for (double kurtosis = 1.0; kurtosis < 2.44; kurtosis += 0.05) {
    EXPECT_GT(shape_variance(kurtosis), before);
    before = shape_variance(kurtosis);
  }
}

/// Of a body whose variance is 4 m^2, with a blur of so many.
AxisSighting sighting(double kurtosis, double looks, double blur = 0.0) {
  return {4.0, 4.0 + blur, (kurtosis - 3.0) * 16.0, looks};
}

TEST(DensityProfile, FewLooksAndWideBeamsAreDrawnToAnEvenDensity) {
  MeasureParams params;
  const auto told = [&](std::vector<AxisSighting> sightings) { return shape_variance(sightings, params); };
  const double all = shape_variance(2.4);
  EXPECT_GT(told({sighting(2.4, 40.0)}), 5.0);
  EXPECT_LT(told({sighting(2.4, 40.0)}) - 5.0, 0.2 * (all - 5.0));
  EXPECT_NEAR(told({sighting(2.4, 40000.0), sighting(1.0, 0.0)}), all, 0.05) << "what has no looks has no say";
  EXPECT_NEAR(told({}), 5.0, 1e-12);
  EXPECT_NEAR(told({sighting(1.5, 1e9, 0.4)}), shape_variance(1.5), 0.8) << "a tenth of blur hides little";
  EXPECT_NEAR(told({sighting(1.5, 1e9, 12.0)}), 5.0, 0.25) << "three times the body's variance nearly all";
  EXPECT_NEAR(told({sighting(2.4, 1e9, 4.0)}), 5.0, 1e-6) << "a dense core may be the beam's skirts";
  EXPECT_NEAR(told({sighting(15.0 / 7.0, 1e9, 12.0)}), 5.0, 1e-6);
  params.find_density = false;
  params.shape_variance = 3.0;
  EXPECT_EQ(told({sighting(2.4, 40000.0)}), 3.0);
}

// Two lumps 10 m apart, 30 degrees below where they are seen from: along the level line between them all is variance, and a
// kurtosis of 1 is a fourth cumulant of -2 variances squared.
TEST(DensityProfile, LevelMomentsTellTheCumulantsAlongAnyAxis) {
  const double down_rad = rad_from_deg(30.0);
  const Point<Sonar> centre{300.0, -200.0, std::hypot(300.0, 200.0) * std::tan(down_rad)};
  LevelMoments moments;
  for (const double side : {-1.0, 1.0}) {
    const double x = centre.x + side * 3.0;
    const double y = centre.y + side * 4.0;
    const double range = std::hypot(x, y) / std::cos(down_rad);
    std::array<double, 5> of_range{};
    for (std::size_t k = 0; k < 5; ++k) of_range[k] = 2.0 * std::pow(range, static_cast<double>(k));
    moments.add(std::atan2(y, x), of_range);
  }
  const auto along = moments.along(std::atan2(4.0, 3.0), centre);
  EXPECT_NEAR(along.variance, 25.0, 1e-6);
  EXPECT_NEAR(along.fourth, -2.0 * 25.0 * 25.0, 1e-2);
  EXPECT_NEAR(moments.along(std::atan2(-3.0, 4.0), centre).variance, 0.0, 1e-6);
  EXPECT_EQ(LevelMoments{}.along(0.3, centre).variance, 0.0);
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

TEST(DensityProfile, DenseCoresAreNoSmallerBodiesAndHollowOnesNoLarger) {
  MeasureParams params;
  params.find_beam_shape = false;
  params.beam_gaussian_share = 1.0;
  params.density_looks = 0.0;
  MeasureParams off = params;
  off.find_density = false;
  for (const auto density : {even, six_decibels, exponential, hollow}) {
    EXPECT_NEAR(volume_ratio(density, 0.0, params), 1.0, 0.15) << marginal_of(density).kurtosis;
    EXPECT_NEAR(volume_ratio(density, 2.0, params), 1.0, 0.17) << "through a pulse of 2 m";
  }
  EXPECT_LT(volume_ratio(exponential, 0.0, off), 0.78);
  EXPECT_GT(volume_ratio(hollow, 0.0, off), 1.12);
}

}  // namespace
}  // namespace sonar
