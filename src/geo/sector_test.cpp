// SPDX-License-Identifier: Apache-2.0
#include "geo/sector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<double> evenly(double first_deg, double step_deg, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back((first_deg + step_deg * i) * kDegree);
  return values;
}

Sector ms70(RangeAxis range) { return {evenly(-45.0, 45.0 / 19.0, 20), evenly(240.0, 2.5, 25), range}; }

// Published check values for cells of 60/25 by 45/20 degrees by 0.38 m near the horizontal.
TEST(Sector, VolumesOfCellsNearTheHorizontal) {
  struct Case {
    double range_m, volume_m3, tolerance;
  };
  for (const Case& c : {Case{15, 0.14, 0.005}, Case{50, 1.56, 0.005}, Case{100, 6.25, 0.005}, Case{250, 39, 0.5},
                        Case{500, 156, 0.5}}) {
    const Sector sector(evenly(-2.25, 2.25, 3), evenly(267.6, 2.4, 3), {c.range_m, 0.38, 1});
    EXPECT_NEAR(sector.volume_m3(1, 1, 0), c.volume_m3, c.tolerance) << c.range_m;
  }
}

// The whole sector's solid angle is (upper - lower azimuth) * (sin upper - sin lower elevation) of its outer bounds.
TEST(Sector, CellsTileTheSector) {
  const std::vector<double> uneven_elevation{-0.8, -0.7, -0.45, -0.4, 0.1};
  const std::vector<double> uneven_azimuth{4.0, 4.1, 4.5};
  const Sector sector(uneven_elevation, uneven_azimuth, {10.0, 0.5, 40});
  double solid_angle = 0.0;
  double volume = 0.0;
  for (int fan = 0; fan < sector.fans(); ++fan) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      solid_angle += sector.solid_angle_sr(fan, beam);
      for (int sample = 0; sample < 40; ++sample) volume += sector.volume_m3(fan, beam, sample);
    }
  }
  // Half a spacing beyond the outermost: -0.85 .. 0.35 rad, 3.95 .. 4.7 rad; ranges 9.75 .. 29.75 m.
  const double whole = (4.7 - 3.95) * (std::sin(0.35) - std::sin(-0.85));
  EXPECT_NEAR(solid_angle, whole, 1e-12);
  EXPECT_NEAR(volume, whole * (std::pow(29.75, 3) - std::pow(9.75, 3)) / 3.0, 1e-8);
  for (int fan = 1; fan < sector.fans(); ++fan) {
    EXPECT_DOUBLE_EQ(sector.elevation_bounds(fan).lower, sector.elevation_bounds(fan - 1).upper);
  }
  for (int beam = 1; beam < sector.beams(); ++beam) {
    EXPECT_DOUBLE_EQ(sector.azimuth_bounds(beam).lower, sector.azimuth_bounds(beam - 1).upper);
  }
}

TEST(Sector, CellsBelowOneSpacingHaveNoVolume) {
  const Sector sector(evenly(-2.0, 2.0, 2), evenly(268.0, 2.0, 2), {-0.8, 0.4, 6});
  // Ranges -0.8, -0.4, 0, 0.4, 0.8, 1.2 m: one spacing is 0.4 m, and "below" leaves 0.4 m itself in.
  for (int sample = 0; sample < 3; ++sample) EXPECT_EQ(sector.volume_m3(0, 0, sample), 0.0) << sample;
  EXPECT_NEAR(sector.shell_m3_per_sr(4), (1.0 - 0.216) / 3.0, 1e-12);
  EXPECT_GT(sector.volume_m3(0, 0, 4), 0.0);
}

TEST(Sector, IndexOfInvertsCentre) {
  const Sector sector = ms70({-0.75519488, 0.37759744, 1324});
  for (const int fan : {0, 1, 10, 18, 19}) {
    for (const int beam : {0, 1, 12, 23, 24}) {
      for (const int sample : {5, 42, 1323}) {
        const SectorIndex index = sector.index_of(sector.centre(fan, beam, sample));
        EXPECT_NEAR(index.fan, fan, 1e-9);
        EXPECT_NEAR(index.beam, beam, 1e-9);
        EXPECT_NEAR(index.sample, sample, 1e-9);
      }
    }
  }
}

TEST(Sector, PlaceAtInvertsIndexOf) {
  const Sector uneven({-0.8, -0.7, -0.45, -0.4, 0.1}, {4.0, 4.1, 4.5}, {10.0, 0.5, 40});
  const Sector lone({-0.3}, {4.7}, {10.0, 0.5, 40});
  for (const Sector& sector : {uneven, lone}) {
    for (const double fan : {-0.6, 0.25, 0.5, 1.9}) {
      for (const double beam : {-0.5, 0.0, 1.3, 2.4}) {
        const SectorIndex index = sector.index_of(sector.place_at({fan, beam, 7.25}));
        EXPECT_NEAR(index.fan, fan, 1e-9);
        EXPECT_NEAR(index.beam, beam, 1e-9);
        EXPECT_NEAR(index.sample, 7.25, 1e-9);
      }
    }
  }
  EXPECT_NEAR(norm(uneven.place_at({2.0, 1.0, 3.0}) - uneven.centre(2, 1, 3)), 0.0, 1e-12);
  const Point<Sonar> corner = uneven.place_at({-0.5, -0.5, 0.0});
  EXPECT_NEAR(norm(corner - Sector::direction(uneven.elevation_bounds(0).lower, uneven.azimuth_bounds(0).lower) * 10.0),
              0.0, 1e-12);
}

TEST(Sector, IndexOfWorksAcrossTheBowAndForOneBeam) {
  const Sector bow(evenly(-30.0, 5.0, 3), evenly(350.0, 5.0, 5), {1.0, 1.0, 100});
  EXPECT_NEAR(bow.index_of(bow.centre(1, 4, 50)).beam, 4.0, 1e-9);
  EXPECT_NEAR(bow.index_of(bow.centre(1, 0, 50)).beam, 0.0, 1e-9);
  const Sector lone({-0.2}, {4.7}, {1.0, 1.0, 100}, 0.12, 0.06);
  const SectorIndex index = lone.index_of(Sector::direction(-0.2 + 0.03, 4.7 - 0.03) * 11.0);
  EXPECT_NEAR(index.fan, 0.25, 1e-9);
  EXPECT_NEAR(index.beam, -0.5, 1e-9);
  EXPECT_NEAR(index.sample, 10.0, 1e-9);
  EXPECT_NEAR(lone.solid_angle_sr(0, 0), 0.06 * (std::sin(-0.14) - std::sin(-0.26)), 1e-15);
}

TEST(Sector, ContainsReachesHalfASpacingBeyondTheOutermost) {
  const Sector sector = ms70({0.0, 1.0, 100});
  EXPECT_TRUE(sector.contains({-0.5, 24.5, 99.5}));
  EXPECT_TRUE(sector.contains({19.5, -0.5, -0.5}));
  EXPECT_FALSE(sector.contains({-0.51, 12, 50}));
  EXPECT_FALSE(sector.contains({10, 24.51, 50}));
  EXPECT_FALSE(sector.contains({10, 12, 99.51}));
  // Straight astern and straight up are far outside a sector that looks to port.
  EXPECT_FALSE(sector.contains(sector.index_of({-50.0, 0.0, 0.0})));
  EXPECT_FALSE(sector.contains(sector.index_of({0.0, 0.0, -50.0})));
}

// Law: places of a cell lie towards its row, at any range; what lies outside lies towards the outermost.
TEST(Sector, PlacesOfACellLieTowardsItsRow) {
  const Sector sector({-0.8, -0.7, -0.45, -0.4, 0.1}, {4.0, 4.1, 4.5}, {10.0, 0.5, 40});
  for (int row = 0; row < 15; ++row) {
    const AngleBounds elevation = sector.elevation_bounds(row / 3);
    const AngleBounds azimuth = sector.azimuth_bounds(row % 3);
    for (const double share : {0.01, 0.5, 0.99}) {
      const auto along = Sector::direction(elevation.lower + share * (elevation.upper - elevation.lower),
                                           azimuth.upper - share * (azimuth.upper - azimuth.lower));
      for (const double range_m : {1.0, 20.0, 300.0}) EXPECT_EQ(sector.row_towards(along * range_m), row) << share;
    }
  }
  EXPECT_EQ(sector.row_towards(Sector::direction(-1.2, 3.5) * 20.0), 0);
  EXPECT_EQ(sector.row_towards(Sector::direction(0.9, 5.0) * 20.0), 14);
}

TEST(Sector, RangeAxisInverts) {
  const RangeAxis range{-0.75, 0.375, 1000};
  EXPECT_DOUBLE_EQ(range.range_m(2.0), 0.0);
  EXPECT_DOUBLE_EQ(range.range_m(1000.0), 374.25);
  EXPECT_DOUBLE_EQ(range.sample_at(374.25), 1000.0);
}

TEST(SectorDeathTest, RefusesFallingAngles) {
  EXPECT_DEATH(Sector({0.1, 0.0}, {0.0, 0.1}, RangeAxis{}), "contract broken");
  EXPECT_DEATH(Sector({}, {0.0}, RangeAxis{}), "contract broken");
}

}  // namespace
}  // namespace sonar
