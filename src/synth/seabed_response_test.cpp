// SPDX-License-Identifier: Apache-2.0
#include "synth/seabed_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "synth/presets.h"
#include "synth/random.h"
#include "synth/seabed_grid.h"

namespace sonar::synth {
namespace {

Scene over_seabed(double relief_m) {
  Scene scene = empty_scene();
  scene.water.seabed_db = -20.0;
  scene.water.seabed_depth_m = 150.0;
  scene.water.seabed_slope_east = 0.05;
  scene.water.seabed_relief_m = relief_m;
  return scene;
}

// The plane is rendered by formula, relief by its patches: where the relief is nothing, both must agree.
TEST(Seabed, ReliefOfNothingIsThePlane) {
  const Layout layout = make_layout(ms70_beams());
  const Scene plane_scene = over_seabed(0.0);
  const Scene relief_scene = over_seabed(1e-9);
  const Seabed plane(layout, plane_scene, {}, 0.3);
  const Seabed relief(layout, relief_scene, {}, 0.3);
  for (const int row : {5, 112, 237, 262, 310}) {
    const int from = plane.first_sample(row);
    const int to = plane.last_sample(row);
    ASSERT_LT(from, to);
    int strongest = from;
    for (int s = from; s < to; ++s) strongest = plane.sv(row, s) > plane.sv(row, strongest) ? s : strongest;
    for (int s = strongest - 25; s <= strongest + 25; s += 5) {
      const double expected_db = db_from_linear(plane.sv(row, s));
      if (expected_db < db_from_linear(plane.sv(row, strongest)) - 15.0) continue;
      EXPECT_NEAR(db_from_linear(relief.sv(row, s)), expected_db, 0.3) << "row " << row << " sample " << s;
    }
    EXPECT_NEAR(relief.limit(row), plane.limit(row), 12);  // the sides of the beam look up and down the slope
  }
}

/// How often echo begins again in a beam that has heard some.
int gaps_of(double relief_m) {
  const Layout layout = make_layout(ms70_beams());
  Scene scene = over_seabed(relief_m);
  scene.water.seabed_slope_east = 0.0;
  scene.water.seabed_depth_m = 70.0;
  const Seabed seabed(layout, scene, {}, 0.0);
  int gaps = 0;
  for (int row = 0; row < static_cast<int>(layout.rows.size()); ++row) {
    for (int s = seabed.first_sample(row) + 1; s < seabed.last_sample(row); ++s) {
      gaps += seabed.sv(row, s) > 0.0 && seabed.sv(row, s - 1) <= 0.0 ? 1 : 0;
    }
  }
  return gaps;
}

// Over a plain a beam hears one rise and fall; over hills its echo breaks off and comes again.
TEST(Seabed, HillsHideWhatLiesBehindThem) {
  EXPECT_EQ(gaps_of(0.0), 0);
  EXPECT_EQ(gaps_of(1e-6), 0);
  EXPECT_GT(gaps_of(12.0), 8);
}

TEST(Terrain, ReliefHasTheDeviationThatWasAskedFor) {
  Scene scene = over_seabed(6.0);
  scene.water.seabed_slope_east = 0.0;
  scene.water.seabed_relief_length_m = 60.0;
  RandomStream random(5, Purpose::placement);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kPlaces = 20'000;
  const Terrain terrain(scene);
  for (int i = 0; i < kPlaces; ++i) {
    const double east_m = random.uniform(-5000.0, 5000.0);
    const double off_m = terrain.depth_m({east_m, random.uniform(-5000.0, 5000.0), 0.0}) - 150.0;
    sum += off_m;
    squares += off_m * off_m;
  }
  EXPECT_NEAR(sum / kPlaces, 0.0, 0.3);
  EXPECT_NEAR(std::sqrt(squares / kPlaces), 6.0, 0.3);
}

TEST(Terrain, TheGridOfDepthsHasTheReliefToo) {
  Scene scene = over_seabed(8.0);
  scene.pings = 40;
  scene.water.seabed_relief_length_m = 1500.0;  // the grid's step is 115 m
  const Terrain terrain(scene);
  const DepthGrid grid = seabed_grid({scene});
  for (int ping = 0; ping < scene.pings; ping += 5) {
    const Point<Enu> ship = ship_at(scene, scene.seconds_of(ping));
    EXPECT_NEAR(grid.depth_at(to_geographic(ship, scene.ship.origin)), terrain.depth_m(ship), 0.6);
  }
}

TEST(Placement, SchoolsKeepToTheSeabedWhereAskedTo) {
  SurveyParams p = survey_params(Preset::standard);
  p.seed = 7;
  p.water.seabed_relief_m = 5.0;
  p.above_seabed_min_m = 6.0;
  p.above_seabed_max_m = 12.0;
  p.raggedness = 0.0;
  p.own_speed_min_mps = p.own_speed_max_mps = 0.0;
  const auto scenes = *survey_scenes(p, ms70_beams());
  int schools = 0;
  for (const Scene& scene : scenes) {
    const Terrain terrain(scene);
    for (const Body& body : scene.bodies) {
      // Abeam is when the ship is nearest to it; there it hangs as high as asked.
      double nearest_m = 1e9;
      double above_m = 0.0;
      for (double t = 0.0; t < scene.seconds_of(scene.pings); t += 1.0) {
        const Point<Enu> centre = body.centre_at(t);
        const double way_m = norm(centre - ship_at(scene, t));
        if (way_m >= nearest_m) continue;
        nearest_m = way_m;
        above_m = terrain.depth_m(centre) + centre.z - body.shape.height_m / 2.0;
      }
      ++schools;
      EXPECT_GT(above_m, 4.0);
      EXPECT_LT(above_m, 14.0);
    }
  }
  EXPECT_GE(schools, 6);
}

}  // namespace
}  // namespace sonar::synth
