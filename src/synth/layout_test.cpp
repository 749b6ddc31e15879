// SPDX-License-Identifier: Apache-2.0
#include "synth/layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sonar::synth {
namespace {

/// Of a line's receive pattern of this width times the pattern that sends, as many times narrower in angle as `sending`: its
/// integral over the angle. No lambda: g++ would sum it while it compiles, for half a minute.
double two_way_integral_rad(double width_deg, double sending) {
  constexpr double kStep = 1e-3;
  double sum = 0.0;
  for (double x = kStep / 2.0; x < 400.0; x += kStep) {
    sum += std::pow(std::sin(x) / x, 2) * std::pow(std::sin(sending * x) / (sending * x), 2) * kStep;
  }
  // (sin x / x)^2 is a half at x = 1.39156, which is half the width.
  return 2.0 * sum * rad_from_deg(width_deg) / 2.0 / 1.39156;
}

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

// The equivalent beam angle is the solid angle of the two-way pattern, here summed over a grid of angles.
TEST(Layout, BeamsThatSendWideHaveTheBeamAngleOfTheirPattern) {
  Beam beam;
  beam.vertical_width_deg = 6.0;
  beam.horizontal_width_deg = 3.0;
  beam.psi_db = -20.0;
  EXPECT_EQ(sounding_beams({beam}, BeamPattern::gaussian).front().psi_db, -20.0);
  EXPECT_EQ(sounding_beams({beam}, BeamPattern::uniform_line).front().psi_db, -20.0);
  EXPECT_NEAR(sounding_beams({beam}, BeamPattern::wide_transmit).front().psi_db,
              db_from_linear(two_way_integral_rad(6.0, 1.0 / 3.0) * two_way_integral_rad(3.0, 1.0 / 3.0)), 0.01);
  EXPECT_NEAR(sounding_beams({beam}, BeamPattern::wide_fan).front().psi_db,
              db_from_linear(two_way_integral_rad(6.0, 1.0) * two_way_integral_rad(3.0, 0.1)), 0.01);
}

}  // namespace
}  // namespace sonar::synth
