// SPDX-License-Identifier: Apache-2.0
#include "synth/layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar::synth {
namespace {

TEST(Layout, RowsFollowAGridThatCrossesTheLimitOf180Degrees) {
  std::vector<Beam> beams;
  for (const double elevation_deg : {-20.0, -10.0}) {
    for (const double azimuth_deg : {-177.5, -175.0, 175.0, 177.5, 180.0}) {
      Beam beam;
      beam.elevation_deg = elevation_deg;
      beam.azimuth_deg = azimuth_deg;
      beams.push_back(beam);
    }
  }
  const Layout layout = make_layout(beams);
  ASSERT_TRUE(layout.grid);
  ASSERT_EQ(layout.rows.size(), 10U);
  for (std::size_t row = 0; row < 10; ++row) {
    // 270 + 175 .. 185, in even steps: sorted, as the search for the beams near a scatterer needs.
    EXPECT_NEAR(deg_from_rad(layout.rows[row].azimuth_rad), 445.0 + 2.5 * static_cast<double>(row % 5), 1e-9);
  }
}

}  // namespace
}  // namespace sonar::synth
