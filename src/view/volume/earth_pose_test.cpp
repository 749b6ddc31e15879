// SPDX-License-Identifier: Apache-2.0
#include "view/volume/earth_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{1200, 900};

/// 30 m a ping towards the north-east, over 180 degrees in the high north; the ship yaws, turns and heaves.
PingNavigation ship(int ping) {
  PingNavigation out;
  out.transducer = destination({70.0, 179.999}, 30.0 * ping, 50.0);
  out.heading_deg = 50.0 + 9.0 * ping + (ping % 2 == 0 ? 3.0 : -3.0);
  out.transducer_depth_m = 7.0 + 0.5 * (ping % 3);
  return out;
}

/// By the geodesics from the ship itself, without a plane that is common to pings.
Point<Sonar> in_frame(const Geographic& place, double depth_m, const PingNavigation& ship) {
  Point<Sonar> out = to_sonar(to_enu(place, ship.transducer), rad_from_deg(ship.heading_deg));
  out.z = depth_m - ship.transducer_depth_m;
  return out;
}

TEST(EarthPose, IsThatOfTheGeodesicsOverTheDateLine) {
  const Point<Sonar> seen{300.0, -450.0, 60.0};
  const Geographic there = to_geographic(to_enu(seen, rad_from_deg(ship(0).heading_deg)), ship(0).transducer);
  const EarthPose first(ship(0).placement(), ship(3).transducer);
  for (int ping = 0; ping <= 20; ++ping) {
    const EarthPose later(ship(ping).placement(), ship(3).transducer);
    const Point<Sonar> now = later.to_ship(first.to_earth(seen));
    EXPECT_LT(norm(now - in_frame(there, 67.0, ship(ping))), 0.02) << ping;
    EXPECT_LT(norm(later.to_earth(now) - first.to_earth(seen)), 1e-9) << "there and back";
  }
}

// Law: what stands still on the earth is seen at one pixel while the ship sails 300 m, and the ship is not.
TEST(StandingStill, APlaceOnTheEarthKeepsItsPixelAndTheShipDoesNot) {
  const Camera camera{{400.0, -900.0, -300.0}, {0.0, -200.0, 50.0}, {0.0, 0.0, -1.0}, 0.6};
  const Geographic place = destination(ship(0).transducer, 250.0, 10.0);
  const auto pixel = [&](const Camera& seen_by, const Point<Sonar>& at) {
    const auto seen = basis(seen_by, kSize).project(at);
    EXPECT_TRUE(seen);
    return seen ? seen->pixel : PixelPoint{};
  };
  const PixelPoint first = pixel(camera, in_frame(place, 80.0, ship(0)));
  const PixelPoint ship_first = pixel(camera, {});
  Camera chained = camera;
  for (int ping = 1; ping <= 10; ++ping) {
    const auto now = standing_still(camera, ship(0), ship(ping));
    ASSERT_TRUE(now);
    chained = *standing_still(chained, ship(ping - 1), ship(ping));
    for (const Camera& one : {*now, chained}) {
      const PixelPoint here = pixel(one, in_frame(place, 80.0, ship(ping)));
      EXPECT_LT(std::hypot(here.x - first.x, here.y - first.y), 0.5) << ping;
      EXPECT_NEAR(norm(one.eye - one.target), norm(camera.eye - camera.target), 1e-6);
      EXPECT_NEAR(one.up.z, -1.0, 1e-12) << "the horizon stays level";
    }
    const PixelPoint ship_now = pixel(*now, {});
    EXPECT_GT(std::hypot(ship_now.x - ship_first.x, ship_now.y - ship_first.y), 10.0 * ping);
  }
}

TEST(StandingStill, NeedsPositionAndHeadingOfBothPings) {
  PingNavigation no_heading = ship(1);
  no_heading.heading_deg = std::nan("");
  PingNavigation no_place = ship(1);
  no_place.transducer.latitude_deg = std::nan("");
  for (const PingNavigation& lacking : {no_heading, no_place}) {
    EXPECT_FALSE(standing_still({}, ship(0), lacking));
    EXPECT_FALSE(standing_still({}, lacking, ship(0)));
  }
  EXPECT_EQ(standing_still({}, ship(1), ship(1))->up.z, -1.0);
}

}  // namespace
}  // namespace sonar
