// SPDX-License-Identifier: Apache-2.0
// Six voxels of the MS70's real beam table, worked by hand in docs/worked-positions.md: 60 N, 5 E, heading 30 degrees,
// transducer 7 m deep, c = 1474.99 m/s, sample interval 0.512 ms, pulse 2.048 ms.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "geo/frames.h"
#include "geo/geodesic.h"
#include "geo/sector.h"

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSpacing_m = 0.37759744;

struct Worked {
  int fan, beam, sample;
  double latitude_deg, longitude_deg, depth_m, volume_m3;
};

Sector real_sector() {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int fan = 0; fan < 20; ++fan) elevation.push_back((-45.0 + 45.0 / 19.0 * fan) * kDegree);
  for (int beam = 0; beam < 25; ++beam) azimuth.push_back((270.0 - 30.0 + 2.5 * beam) * kDegree);
  return {elevation, azimuth, {-2 * kSpacing_m, kSpacing_m, 1324}};
}

TEST(Position, SixVoxelsWorkedByHand) {
  const std::vector<Worked> worked{
      {0, 0, 1323, 59.999999849, 4.993679046, 359.709259, 119.812055},
      {0, 24, 1323, 60.002741627, 4.996839261, 359.709259, 119.812055},
      {19, 0, 1319, 59.999999699, 4.991087889, 7.0, 168.415256},
      {19, 24, 1319, 60.003865483, 4.995543424, 7.0, 168.415256},
      {19, 12, 700, 60.001182764, 4.995909312, 7.0, 47.306496},
      {10, 0, 42, 60.0, 4.999747838, 12.490387, 0.144736},
  };
  const Sector sector = real_sector();
  const Placement ship{{60.0, 5.0}, 30.0 * kDegree, 7.0};
  for (const Worked& voxel : worked) {
    const Point<Enu> local = to_enu(sector.centre(voxel.fan, voxel.beam, voxel.sample), ship.heading_rad);
    const Geographic place = to_geographic(local, ship.transducer);
    // 1e-8 degrees is 1.1 mm on the ground; the hand's series ends at terms of 0.01 mm.
    EXPECT_NEAR(place.latitude_deg, voxel.latitude_deg, 2e-9) << voxel.fan << ' ' << voxel.beam;
    EXPECT_NEAR(place.longitude_deg, voxel.longitude_deg, 2e-9) << voxel.fan << ' ' << voxel.beam;
    EXPECT_NEAR(ship.transducer_depth_m - local.z, voxel.depth_m, 2e-6) << voxel.fan << ' ' << voxel.beam;
    EXPECT_NEAR(sector.volume_m3(voxel.fan, voxel.beam, voxel.sample), voxel.volume_m3, 2e-6);
  }
}

// Turning the ship by 90 degrees turns every voxel by 90 degrees about it: east becomes what north was.
TEST(Position, HeadingPlusNinetyTurnsTheSector) {
  const Sector sector = real_sector();
  for (const int fan : {0, 10, 19}) {
    const Point<Sonar> p = sector.centre(fan, 3, 900);
    const Point<Enu> before = to_enu(p, 0.4);
    const Point<Enu> after = to_enu(p, 0.4 + std::numbers::pi / 2);
    EXPECT_NEAR(after.x, before.y, 1e-9);
    EXPECT_NEAR(after.y, -before.x, 1e-9);
    EXPECT_EQ(after.z, before.z);
  }
}

// The same place relative to the ship, wherever on a parallel the ship is, the 180th meridian included.
TEST(Position, LongitudeOnlyShifts) {
  const Sector sector = real_sector();
  for (const double latitude : {0.0, 70.0, -70.0}) {
    const Point<Enu> local = to_enu(sector.centre(5, 7, 1200), 2.0);
    const Geographic at_five = to_geographic(local, {latitude, 5.0});
    const Geographic at_dateline = to_geographic(local, {latitude, 179.999});
    EXPECT_NEAR(at_five.latitude_deg, at_dateline.latitude_deg, 1e-12);
    EXPECT_NEAR(wrap_180(at_dateline.longitude_deg - 174.999), at_five.longitude_deg, 1e-11);
    EXPECT_GE(at_dateline.longitude_deg, -180.0);
    EXPECT_LT(at_dateline.longitude_deg, 180.0);
  }
}

// Beams fixed to the hull, by hand: rolled port up by 30 degrees a level beam to port rises, and 100 m along it lie 50 m
// higher and 86.60 m to port; pitched bow up by 30 degrees a level beam to the bow does the same ahead.
TEST(Position, BeamsOfTheHullTurnWithRollAndPitch) {
  Placement ship{{60.0, 5.0}, 0.0, 7.0};
  EXPECT_EQ(levelled({10.0, -20.0, 30.0}, ship), (Point<Sonar>{10.0, -20.0, 30.0}));
  ship.roll_rad = 30.0 * kDegree;
  const Point<Sonar> port = levelled({0.0, -100.0, 0.0}, ship);
  EXPECT_NEAR(port.x, 0.0, 1e-9);
  EXPECT_NEAR(port.y, -86.60254, 1e-5);
  EXPECT_NEAR(port.z, -50.0, 1e-9);
  // Straight down in the hull is to port below: 100 sin 30 to port.
  EXPECT_NEAR(levelled({0.0, 0.0, 100.0}, ship).y, -50.0, 1e-9);
  ship.roll_rad = 0.0;
  ship.pitch_rad = 30.0 * kDegree;
  const Point<Sonar> ahead = levelled({100.0, 0.0, 0.0}, ship);
  EXPECT_NEAR(ahead.x, 86.60254, 1e-5);
  EXPECT_NEAR(ahead.z, -50.0, 1e-9);
}

TEST(Position, LevellingGoesThereAndBack) {
  Placement ship{{60.0, 5.0}, 1.0, 7.0, 0.2, -0.1};
  const Point<Sonar> p{30.0, -80.0, 45.0};
  EXPECT_NEAR(norm(unlevelled(levelled(p, ship), ship) - p), 0.0, 1e-9);
  EXPECT_NEAR(norm(levelled(p, ship)), norm(p), 1e-9);
}

}  // namespace
}  // namespace sonar
