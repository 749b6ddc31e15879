// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/units.h"
#include "geo/refraction.h"
#include "view/maps/map_example.h"
#include "view/maps/observation_map.h"

namespace sonar {
namespace {

using map_example::block;

constexpr PixelSize kSize{700, 600};

/// By Rodrigues: turned about an axis through the transducer.
Point<Vessel> turned(const Point<Vessel>& v, const Point<Vessel>& axis, double angle) {
  const Point<Vessel> cross{axis.y * v.z - axis.z * v.y, axis.z * v.x - axis.x * v.z, axis.x * v.y - axis.y * v.x};
  const double along = axis.x * v.x + axis.y * v.y + axis.z * v.z;
  return v * std::cos(angle) + cross * std::sin(angle) + axis * (along * (1.0 - std::cos(angle)));
}

/// The confidence of the voxel whose cell holds a place in the hull's frame, by the definition of cells.
std::uint8_t confidence_there(const Sector& sector, const PingMask& mask, const Point<Vessel>& p) {
  const double range_m = norm(p);
  const double elevation = std::asin(-p.z / range_m);
  const double azimuth = rad_from_deg(wrap_360(deg_from_rad(std::atan2(p.y, p.x))));
  std::size_t next = 0;
  std::uint8_t best = 0;
  for (const Run& run : mask.runs) {
    const AngleBounds a = sector.azimuth_bounds(run.row % sector.beams());
    const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
    const bool inside = azimuth >= a.lower && azimuth < a.upper && elevation >= e.lower && elevation < e.upper;
    const auto sample = static_cast<int>(std::lround(sector.range().sample_at(range_m)));
    if (inside && sample >= run.first_sample && sample < run.end()) {
      best = std::max(best, mask.confidence[next + static_cast<std::size_t>(sample - run.first_sample)]);
    }
    next += static_cast<std::size_t>(run.count);
  }
  return best;
}

// Of beams fixed to a hull that rolls and pitches each cell takes the surest voxel that lies anywhere below it.
TEST(TurnedMasks, ACellTakesTheSurestVoxelBelowIt) {
  const Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  PingMask mask = block(1, 0, 2, 20, 6, 90);
  const PingMask over = block(2, 1, 2, 21, 8, 200);
  mask.runs.insert(mask.runs.end(), over.runs.begin(), over.runs.end());
  mask.confidence.insert(mask.confidence.end(), over.confidence.begin(), over.confidence.end());
  mask.confidence[2] = 250;
  const PlanRaster raster{20.0, -70.0, 0.0, 0.5, -0.5, 0.0, 120, 80};  // bow up, starboard right, 0.5 m
  for (const auto& [roll_deg, pitch_deg] : {std::pair{0.0, 0.0}, {-12.0, 0.0}, {9.0, 6.0}, {0.0, -10.0}}) {
    Placement placement;
    placement.heading_rad = 2.0;  // does not count
    placement.roll_rad = rad_from_deg(roll_deg);
    placement.pitch_rad = rad_from_deg(pitch_deg);
    const MaskPatch patch = patch_from_above(sector, mask, placement, raster);
    ASSERT_FALSE(patch.empty());
    const auto cells = map_example::compared(patch, raster, [&](int x, int y) {
      std::uint8_t surest = 0;
      for (double z = -20.0; z <= 40.0; z += 0.1) {
        const Point<Vessel> pitched =
            turned({20.0 - 0.5 * y, -70.0 + 0.5 * x, z}, {0.0, 1.0, 0.0}, -placement.pitch_rad);
        const Point<Vessel> hull = turned(pitched, {1.0, 0.0, 0.0}, -placement.roll_rad);
        surest = std::max(surest, confidence_there(sector, mask, hull));
      }
      return surest;
    });
    EXPECT_GT(cells.lit, 300);
    // Chords for arcs, and steps of 0.1 m down, tell in a few cells along the rim.
    EXPECT_LT(cells.different, cells.lit / 20) << roll_deg << " " << pitch_deg;
  }
}

/// One ping of a ship that heads north, with a school of four samples, 98 to 106 m away and 20 to 30 degrees below the
/// beams' level, 5 degrees to both sides of abeam to port.
ObservationProduct one_ping() {
  ObservationProduct p = map_example::product("obs-0001", 1);
  map_example::add_school(p, 1, p.pings[0].transducer, 0, 0, block(0, 1, 2, 50, 4));
  return p;
}

/// Speed falls by 2 m/s each metre, from 1490 m/s at the transducer, at which ranges are counted.
std::shared_ptr<const Refraction> falling_speed() {
  return std::make_shared<const Refraction>(SoundProfile{{0.0, 1504.0}, {100.0, 1304.0}}, 7.0, 1490.0, 120.0);
}

/// How far off a place lies, m: on the circle that a ray is in an even gradient, artanh of the dip's sine grows by 2 each
/// second, and the level way is c / (2 cos dip) times the change of that sine (by hand).
double level_m(double dip_deg, double range_m, bool bends) {
  const double cosine = std::cos(rad_from_deg(dip_deg));
  if (!bends) return range_m * cosine;
  const double sine = std::sin(rad_from_deg(dip_deg));
  return 1490.0 / (2.0 * cosine) * (std::tanh(std::atanh(sine) + 2.0 * range_m / 1490.0) - sine);
}

PlacementOf placed(double roll_deg, double pitch_deg, const std::shared_ptr<const Refraction>& rays) {
  return [=](const PingNavigation& ping) {
    Placement placement = ping.placement();
    placement.roll_rad = rad_from_deg(roll_deg);
    placement.pitch_rad = rad_from_deg(pitch_deg);
    placement.rays = rays;
    return placement;
  };
}

/// The map, near enough to see 0.3 m.
Result<ObservationMapBase> near_map(const ObservationProduct& p, const PlacementOf& placed_by) {
  return observation_map_base(p, kSize, light_theme(kSize), {4.0, {}}, false, false, placed_by);
}

int school_there(const ObservationMapBase& base, const MaskMosaic& mosaic, const Geographic& place) {
  const PixelPoint at = *base.map.at(place);
  const int x = static_cast<int>(std::floor((at.x - base.map.place.x) / mosaic.cell_px()));
  const int y = static_cast<int>(std::floor((at.y - base.map.place.y) / mosaic.cell_px()));
  if (x < 0 || y < 0 || x >= mosaic.width() || y >= mosaic.height()) return -1;
  return MaskMosaic::school(mosaic.at(x, y));
}

// Abeam a roll changes the dip and nothing else.
TEST(TurnedMasks, ASchoolReachesAsFarAsRollAndRaysHaveIt) {
  const ObservationProduct p = one_ping();
  const auto rays = falling_speed();
  for (const bool bends : {false, true}) {
    for (const double roll_deg : {0.0, -8.0}) {
      const auto base = near_map(p, placed(roll_deg, 0.0, bends ? rays : nullptr));
      ASSERT_TRUE(base);
      const MaskMosaic mosaic = mask_mosaic(*base, p);
      double near_m = 1e9;
      double far_m = 0.0;
      for (double m = 60.0; m < 110.0; m += 0.05) {
        if (school_there(*base, mosaic, destination(p.pings[0].transducer, m, 269.9)) != 1) continue;
        near_m = std::min(near_m, m);
        far_m = std::max(far_m, m);
      }
      // Straight and level, masks lie in bins as long as a sample, 2 m.
      const double within_m = bends || roll_deg != 0.0 ? 0.5 : 1.2;
      EXPECT_NEAR(near_m, level_m(30.0 - roll_deg, 98.0, bends), within_m) << bends << " " << roll_deg;
      EXPECT_NEAR(far_m, level_m(20.0 - roll_deg, 106.0, bends), within_m) << bends << " " << roll_deg;
    }
  }
  EXPECT_GT(std::abs(level_m(38.0, 98.0, true) - level_m(38.0, 98.0, false)), 5.0) << "bending is to be seen";
}

// The middle of the school's cells, rolled, pitched and bent by hand, lies in the school; where it lay straight and level
// there is none.
TEST(TurnedMasks, ASchoolLiesOverItsPlaceInTheTables) {
  const ObservationProduct p = one_ping();
  const auto base = near_map(p, placed(-8.0, 10.0, falling_speed()));
  ASSERT_TRUE(base);
  const MaskMosaic mosaic = mask_mosaic(*base, p);
  const double dip = rad_from_deg(25.0 + 8.0);
  const double pitch = rad_from_deg(10.0);
  const double ahead = std::sin(dip) * std::sin(pitch);
  const double dip_then_deg = deg_from_rad(std::asin(std::sin(dip) * std::cos(pitch)));
  const double bearing_deg = 270.0 + deg_from_rad(std::atan2(ahead, std::cos(dip)));
  const Geographic& ship = p.pings[0].transducer;
  EXPECT_EQ(school_there(*base, mosaic, destination(ship, level_m(dip_then_deg, 102.0, true), bearing_deg)), 1);
  EXPECT_EQ(school_there(*base, mosaic, destination(ship, level_m(25.0, 102.0, false), 270.0)), 0);
}

// Beams 0 to 10 degrees down that end at 118 m: a list of 30 degrees towards them takes the farthest to 118 cos 30.
TEST(TurnedMasks, TheFootprintTurnsToo) {
  const ObservationProduct p = one_ping();
  const auto reach_m = [&](double roll_deg) {
    const auto base = near_map(p, placed(roll_deg, 0.0, nullptr));
    const PixelPoint ship = *base->map.at(p.pings[0].transducer);
    double west_px = 0.0;
    for (const PixelPoint& q : base->footprints.at(0)) west_px = std::max(west_px, ship.x - q.x);
    return west_px * base->map.true_metres_per_px(p.pings[0].transducer);
  };
  EXPECT_NEAR(reach_m(0.0), 118.0, 0.2);
  EXPECT_NEAR(reach_m(-30.0), 118.0 * std::cos(rad_from_deg(30.0)), 0.2);
}

// Stabilised beams and straight paths: the same bits, however the ship rolls.
TEST(TurnedMasks, StabilisedBeamsStayWhereTheyAre) {
  ObservationProduct p = one_ping();
  const auto still = near_map(p, &PingNavigation::placement);
  ASSERT_TRUE(still);
  const MaskMosaic of_still = mask_mosaic(*still, p);
  p.pings[0].roll_deg = -8.0;
  p.pings[0].pitch_deg = 10.0;
  const auto rolling = near_map(p, &PingNavigation::placement);
  ASSERT_TRUE(rolling);
  EXPECT_TRUE(mask_mosaic(*rolling, p).cells() == of_still.cells());
  EXPECT_TRUE(rolling->footprints == still->footprints);
}

// What is damaged in a product shows nothing rather than anything.
TEST(TurnedMasks, UnknownRollShowsNothing) {
  const ObservationProduct p = one_ping();
  const auto base = near_map(p, placed(std::nan(""), 0.0, nullptr));
  ASSERT_TRUE(base);
  const MaskMosaic mosaic = mask_mosaic(*base, p);
  EXPECT_TRUE(std::all_of(mosaic.cells().begin(), mosaic.cells().end(), [](auto c) { return c == 0; }));
}

}  // namespace
}  // namespace sonar
