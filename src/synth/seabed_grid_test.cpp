// SPDX-License-Identifier: Apache-2.0
#include "synth/seabed_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/geodesic.h"
#include "synth/layout.h"
#include "synth/presets.h"
#include "synth/seabed_response.h"

namespace sonar::synth {
namespace {

/// The hard preset's seabed slopes two ways; its observations lie 15 km apart.
std::vector<Scene> scenes() {
  SurveyParams p = survey_params(Preset::hard);
  p.observations = 3;
  p.schools = 0;
  p.pings = 60;
  return *survey_scenes(p, ms70_beams());
}

TEST(SeabedGrid, AgreesWithTheSeabedUnderAndBesideEveryPing) {
  const auto all = scenes();
  const DepthGrid grid = seabed_grid(all);
  for (const Scene& scene : all) {
    const Layout layout = make_layout(scene.beams);
    for (int ping = 0; ping < scene.pings; ping += 7) {
      const Point<Enu> ship = ship_at(scene, scene.seconds_of(ping));
      const Geographic place = to_geographic(ship, scene.ship.origin);
      EXPECT_NEAR(grid.depth_at(place), Seabed(layout, scene, ship, 0.0).depth_m(), 0.05);
      // 450 m to each side: the plane by its definition.
      for (int bearing = 0; bearing < 360; bearing += 45) {
        const Point<Enu> p = to_enu(destination(place, 450.0, bearing), scene.ship.origin);
        const double plane =
            scene.water.seabed_depth_m + scene.water.seabed_slope_east * p.x + scene.water.seabed_slope_north * p.y;
        EXPECT_NEAR(grid.depth_at(destination(place, 450.0, bearing)), plane, 0.05);
      }
    }
  }
}

TEST(SeabedGrid, HasNoJumpsAndNoLand) {
  const DepthGrid grid = seabed_grid(scenes());
  ASSERT_GT(grid.rows, 50);
  ASSERT_EQ(grid.depth_m.size(), static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 1; column < grid.columns; ++column) {
      const double here = static_cast<double>(grid.at(row, column));
      EXPECT_GT(here, 10.0);
      EXPECT_LT(std::abs(here - static_cast<double>(grid.at(row, column - 1))), 60.0);  // a step is 115 m
    }
  }
}

TEST(SeabedGrid, NoScenesNoGrid) { EXPECT_EQ(seabed_grid({}).rows, 0); }

}  // namespace
}  // namespace sonar::synth
