// SPDX-License-Identifier: Apache-2.0
#include "school/measure/describe_school.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/test_body.h"
#include "school/test_ping.h"

namespace sonar {
namespace {

constexpr double kPi = std::numbers::pi;

/// Bodies of evenly dense fish as a sonar without beam width would hear them.
struct SharpPing : test::MeasuredPing {
  Point<Sonar> centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 100.0;

  template <class Inside>
  SchoolPingRow row_of(Inside inside, double sv = 1e-4) {
    mask = test::body_mask(sector, inside);
    for (const sonar::Run& run : mask.runs) {
      const auto row = expected.view().row(run.row);
      std::fill(row.begin() + run.first_sample, row.begin() + run.end(), sv);
    }
    return measured(1, false);
  }
  /// Half axes along a level direction, square to it, and up.
  SchoolPingRow ellipsoid(double a, double b, double c, double azimuth_deg) {
    const double x = std::cos(rad_from_deg(azimuth_deg));
    const double y = std::sin(rad_from_deg(azimuth_deg));
    return row_of([&](const Point<Sonar>& p) {
      const Point<Sonar> d = p - centre;
      const double along = (d.x * x + d.y * y) / a;
      const double across = (d.y * x - d.x * y) / b;
      return along * along + across * across + d.z * d.z / (c * c) < 1.0;
    });
  }
};

TEST(DescribeSchool, ABall) {
  SharpPing ping;
  const SchoolPingRow row = ping.ellipsoid(20, 20, 20, 0.0);
  EXPECT_NEAR(row.equivalent_radius_m, 20.0, 0.2);
  EXPECT_NEAR(row.surface_m2 / (4.0 * kPi * 400.0), 1.0, 0.03);
  EXPECT_NEAR(row.sphericity, 1.0, 0.03);
  EXPECT_NEAR(row.roughness, 1.0, 0.03);
  EXPECT_NEAR(row.area_m2 / (kPi * 400.0), 1.0, 0.08);
  EXPECT_NEAR(row.box_length_m, 40.0, 5.0) << "and up to a cell";
  EXPECT_NEAR(row.box_thickness_m, 40.0, 3.0);
  EXPECT_EQ(row.n_vacuoles, 0.0);
  EXPECT_EQ(row.vacuole_fraction, 0.0);
  EXPECT_EQ(row.n_nuclei, 1.0);
  EXPECT_NEAR(row.sv_variation, 0.0, 0.01);
  EXPECT_NEAR(row.core_edge_db, 0.0, 0.02);
  // sigma_bs = s_v V; s_A = 4 pi 1852^2 sigma_bs / area
  EXPECT_NEAR(row.nasc_m2_nmi2 / (43101444.8 * 1e-4 * row.volume_m3 / row.area_m2), 1.0, 0.01);
  EXPECT_NEAR(row.horizontal_range_m, 100.0 * std::cos(rad_from_deg(22.0)), 0.5);
  EXPECT_EQ(row.surface_distance_m, row.depth_min_m);
  EXPECT_TRUE(std::isnan(row.bottom_distance_m)) << "no seabed";
  EXPECT_NEAR(row.mass_latitude, row.latitude, 1e-8);
  EXPECT_NEAR(row.mass_depth_m, row.depth_m, 1e-3);
}

// An ellipsoid is smooth, but no ball: its sphericity by Knud Thomsen's surface.
TEST(DescribeSchool, AnEllipsoidTurnsWithTheShip) {
  SharpPing ping;
  const double p = 1.6075;
  const auto pair = [&](double a, double b) { return std::pow(a * b, p); };
  const double surface = 4.0 * kPi * std::pow((pair(36, 14) + pair(36, 9) + pair(14, 9)) / 3.0, 1.0 / p);
  const double ball = 4.0 * kPi * std::pow(36.0 * 14.0 * 9.0, 2.0 / 3.0);
  for (const double heading_deg : {0.0, 75.0, 200.0}) {
    ping.placement.heading_rad = rad_from_deg(heading_deg);
    const SchoolPingRow row = ping.ellipsoid(36, 14, 9, 20.0);
    EXPECT_NEAR(row.sphericity / (ball / surface), 1.0, 0.06);
    EXPECT_NEAR(row.roughness, 1.0, 0.06);
    EXPECT_NEAR(row.box_length_m, 72.0, 4.0);
    EXPECT_NEAR(row.box_width_m, 28.0, 5.0);
    EXPECT_NEAR(row.box_thickness_m, 18.0, 5.0);
    EXPECT_NEAR(std::remainder(row.box_bearing_deg - heading_deg - 20.0, 180.0), 0.0, 2.0);
    EXPECT_NEAR(row.box_tilt_deg, 0.0, 2.0);
    EXPECT_NEAR(row.incidence_deg, 74.0, 6.0) << "cos = cos(22) cos(268 - 20)";
    ping.expected = Array3<double>(ping.expected.shape());
  }
}

// A cigar that rises by 30 degrees towards the bow.
TEST(DescribeSchool, TheBoxTiltsWithTheBody) {
  SharpPing ping;
  const Point<Sonar> axis{std::cos(rad_from_deg(30.0)), 0.0, -std::sin(rad_from_deg(30.0))};
  ping.placement.heading_rad = rad_from_deg(40.0);
  const SchoolPingRow row = ping.row_of([&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - ping.centre;
    const double along = d.x * axis.x + d.z * axis.z;
    return std::abs(along) < 35.0 && norm(d - axis * along) < 7.0;
  });
  EXPECT_NEAR(row.box_bearing_deg, 40.0, 3.0);
  EXPECT_NEAR(row.box_tilt_deg, 30.0, 3.0);
  EXPECT_NEAR(row.box_length_m, 70.0, 8.0);
}

// A shell counts as the ball that it is from outside; what is missing inside is told as a vacuole.
TEST(DescribeSchool, AHollowBall) {
  SharpPing ping;
  const SchoolPingRow row = ping.row_of([&](const Point<Sonar>& p) {
    const double r = norm(p - ping.centre);
    return r < 22.0 && r >= 11.0;
  });
  EXPECT_EQ(row.n_vacuoles, 1.0);
  EXPECT_NEAR(row.vacuole_fraction, 1.0 / 8.0, 0.01);
  EXPECT_NEAR(row.volume_m3 / (4.0 / 3.0 * kPi * (22.0 * 22.0 * 22.0 - 11.0 * 11.0 * 11.0)), 1.0, 0.03);
  EXPECT_NEAR(row.sphericity, 1.0, 0.03);
  EXPECT_NEAR(row.surface_m2 / (4.0 * kPi * 22.0 * 22.0), 1.0, 0.03);
}

// Half a ring.
TEST(DescribeSchool, ABentBody) {
  SharpPing ping;
  const double ring = 25.0;
  const double tube = 9.0;
  ping.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 70.0;
  const SchoolPingRow row = ping.row_of([&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - ping.centre;
    return d.x > 0.0 && std::hypot(std::hypot(d.x, d.y) - ring, d.z) < tube;
  });
  const double volume = kPi * kPi * ring * tube * tube;
  const double surface = 2.0 * kPi * kPi * ring * tube + 2.0 * kPi * tube * tube;
  EXPECT_NEAR(row.sphericity / (std::cbrt(36.0 * kPi * volume * volume) / surface), 1.0, 0.06);
  EXPECT_EQ(row.n_vacuoles, 0.0);
  EXPECT_NEAR(row.box_length_m, 2.0 * (ring + tube), 4.0);
}

// A gear of four lobes: its outline in closed form but for the integral along it.
TEST(DescribeSchool, ALobedBodyIsRough) {
  SharpPing ping;
  ping.centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 80.0;
  const auto outline = [](double angle) { return 24.0 * (1.0 + 0.35 * std::cos(4.0 * angle)); };
  const SchoolPingRow row = ping.row_of([&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - ping.centre;
    return std::abs(d.z) < 18.0 && std::hypot(d.x, d.y) < outline(std::atan2(d.y, d.x));
  });
  double around = 0.0;
  double area = 0.0;
  for (int k = 0; k < 3600; ++k) {
    const double angle = 2.0 * kPi * k / 3600.0;
    const double slope = -24.0 * 0.35 * 4.0 * std::sin(4.0 * angle);
    around += 2.0 * kPi / 3600.0 * std::hypot(outline(angle), slope);
    area += 2.0 * kPi / 3600.0 * outline(angle) * outline(angle) / 2.0;
  }
  EXPECT_NEAR(row.surface_m2 / (around * 36.0 + 2.0 * area), 1.0, 0.08);
  EXPECT_GT(row.roughness, 1.2);
}

// A surface of so few beams is the beam's.
TEST(DescribeSchool, TwoBeamsHaveNoSurface) {
  SharpPing ping;
  ping.mask.runs = {{10 * 25 + 11, 300, 40}, {10 * 25 + 12, 300, 40}};
  ping.mask.confidence.assign(80, 255);
  for (double& sv : ping.expected.all()) sv = 1e-5;
  const SchoolPingRow row = ping.measured(1, false);
  EXPECT_TRUE(std::isnan(row.surface_m2));
  EXPECT_TRUE(std::isnan(row.sphericity));
  EXPECT_GT(row.area_m2, 0.0);
}

TEST(DescribeSchool, TheCentreOfMassLiesWhereTheEchoIs) {
  SharpPing ping;
  const auto inside = [&](const Point<Sonar>& p) { return norm(p - ping.centre) < 20.0; };
  ping.mask = test::body_mask(ping.sector, inside);
  for (const sonar::Run& run : ping.mask.runs) {
    const double nearer = 20.0 / (run.row % 25 < 11 ? 1.0 : 4.0);  // beams aft of the middle hear four times as much
    for (int s = run.first_sample; s < run.end(); ++s) {
      ping.expected.view().row(run.row)[static_cast<std::size_t>(s)] = 1e-5 * nearer;
    }
  }
  const SchoolPingRow row = ping.measured(1, false);
  const GeodesicStep step = geodesic({row.latitude, row.longitude}, {row.mass_latitude, row.mass_longitude});
  // halves of a ball have their centres 3/8 R off: (4 - 1) / (4 + 1) of that, to a beam's width
  EXPECT_NEAR(step.distance_m, 3.0 / 8.0 * 20.0 * 0.6, 1.0);
  EXPECT_NEAR(std::remainder(step.bearing_deg - 180.0, 360.0), 0.0, 15.0) << "aft, on a northerly heading";
}

// B = 0.44 x 5 x 10^0.45 = 6.2004 degrees; tan(10) / tan(3.1002) = 3.2555.
TEST(DinerRelativeSize, ByHand) {
  EXPECT_NEAR(diner_relative_size(20.0, 5.0, 10.0), 3.2555, 1e-3);
  EXPECT_TRUE(std::isnan(diner_relative_size(20.0, 5.0, 0.0)));
  EXPECT_TRUE(std::isnan(diner_relative_size(20.0, 5.0, kUnknown)));
  EXPECT_GT(diner_relative_size(20.0, 5.0, 3.0), diner_relative_size(20.0, 5.0, 20.0)) << "louder, hence wider beams";
}

TEST(PrincipalAxes, OfATurnedBody) {
  // variances 9, 4, 1 along (2, 2, 1) / 3, (-2, 1, 2) / 3, (1, -2, 2) / 3
  const std::array<Vector3, 3> axes{
      {{2 / 3.0, 2 / 3.0, 1 / 3.0}, {-2 / 3.0, 1 / 3.0, 2 / 3.0}, {1 / 3.0, -2 / 3.0, 2 / 3.0}}};
  const std::array<double, 3> variance{9.0, 4.0, 1.0};
  Covariance3 c{};
  for (const std::size_t k : {2U, 0U, 1U}) add_square(c, axes[k], variance[k]);
  const PrincipalAxes found = principal_axes(c);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.variance[k], variance[k], 1e-12);
    double along = 0.0;
    for (std::size_t i = 0; i < 3; ++i) along += found.axis[k][i] * axes[k][i];
    EXPECT_NEAR(std::abs(along), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace sonar
