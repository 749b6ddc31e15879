// SPDX-License-Identifier: Apache-2.0
#include "model/beam_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace sonar {
namespace {

/// A sounder with `fans` x `beams` directions by the MS70's laws: elevation -45 .. 0, azimuth -30 .. 30 from abeam,
/// 1850 Hz a fan from 111 075 Hz, widths 300 888 / (f cos azimuth) and 549 327.5 / (f cos elevation) degrees.
SounderConfig regular(int fans, int beams) {
  SounderConfig config;
  config.sounder_name = "MBS";
  config.kind = SounderKind::ms70;
  for (int fan = 0; fan < fans; ++fan) {
    for (int beam = 0; beam < beams; ++beam) {
      BeamConfig b;
      b.direction_deg = {fans > 1 ? -45.0 + 45.0 * fan / (fans - 1) : -20.0,
                         beams > 1 ? -30.0 + 60.0 * beam / (beams - 1) : 0.0, 0.0};
      b.frequency_hz = 111075.0 - 1850.0 * fan;
      const double radian = std::numbers::pi / 180.0;
      b.width_athwartship_deg = 300888.0 / (b.frequency_hz * std::cos(b.direction_deg[1] * radian));
      b.width_alongship_deg = 549327.5 / (b.frequency_hz * std::cos(b.direction_deg[0] * radian));
      config.beams.push_back(b);
    }
  }
  return config;
}

TEST(BeamGrid, TheMs70sTwentyFansOfTwentyFiveBeams) {
  const Result<BeamGrid> grid = derive_beam_grid(regular(20, 25), 270.0);
  ASSERT_TRUE(grid);
  ASSERT_EQ(grid->fans(), 20);
  ASSERT_EQ(grid->beams(), 25);
  for (int fan = 0; fan < 20; ++fan) {
    EXPECT_NEAR(grid->elevation_deg[static_cast<std::size_t>(fan)], -45.0 + 2.368421052631579 * fan, 1e-9);
    EXPECT_NEAR(grid->frequency_hz[static_cast<std::size_t>(fan)], 111075.0 - 1850.0 * fan, 1e-6);
  }
  for (int beam = 0; beam < 25; ++beam) {
    EXPECT_NEAR(grid->azimuth_deg[static_cast<std::size_t>(beam)], 240.0 + 2.5 * beam, 1e-9);
  }
  for (int channel = 0; channel < 500; ++channel) {
    EXPECT_EQ(grid->channel[static_cast<std::size_t>(channel)], channel);  // fan = channel / 25, beam = channel % 25
  }
  // Corners and middle of the published table of widths.
  EXPECT_NEAR(grid->vertical_width_deg[0], 6.994, 1e-3);
  EXPECT_NEAR(grid->horizontal_width_deg[0], 3.128, 1e-3);
  EXPECT_NEAR(grid->horizontal_width_deg[12], 2.709, 1e-3);
  EXPECT_NEAR(grid->vertical_width_deg[475], 7.235, 1e-3);
  EXPECT_NEAR(grid->horizontal_width_deg[499], 4.576, 1e-3);
}

TEST(BeamGrid, StarboardMounting) {
  const Result<BeamGrid> grid = derive_beam_grid(regular(20, 25), 90.0);
  ASSERT_TRUE(grid);
  EXPECT_NEAR(grid->azimuth_deg.front(), 60.0, 1e-9);
  EXPECT_NEAR(grid->azimuth_deg.back(), 120.0, 1e-9);
  EXPECT_EQ(grid->mounting_azimuth_deg, 90.0);
}

TEST(BeamGrid, AnyChannelOrderGivesTheSameDirections) {
  SounderConfig config = regular(20, 25);
  // 7 and 500 share no divisor: every channel once.
  std::vector<BeamConfig> shuffled(config.beams.size());
  for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i * 7 % 500] = config.beams[i];
  config.beams = shuffled;
  const Result<BeamGrid> grid = derive_beam_grid(config, 270.0);
  const Result<BeamGrid> ordered = derive_beam_grid(regular(20, 25), 270.0);
  ASSERT_TRUE(grid && ordered);
  ASSERT_EQ(grid->fans(), 20);
  ASSERT_EQ(grid->beams(), 25);
  const std::vector<int> rows = grid->row_of_channel();
  for (std::size_t row = 0; row < 500; ++row) {
    EXPECT_EQ(grid->channel[row], static_cast<int>(row * 7 % 500));
    EXPECT_EQ(rows[row * 7 % 500], static_cast<int>(row));
    EXPECT_NEAR(grid->elevation_deg[row / 25], ordered->elevation_deg[row / 25], 1e-12);
    EXPECT_EQ(grid->vertical_width_deg[row], ordered->vertical_width_deg[row]);
  }
}

TEST(BeamGrid, DirectionsStoredAsFloatsStillCluster) {
  SounderConfig config = regular(20, 25);
  for (std::size_t i = 0; i < config.beams.size(); ++i) {
    const double jitter = 0.02 * std::sin(static_cast<double>(i) * 12.9);
    config.beams[i].direction_deg[0] = static_cast<float>(config.beams[i].direction_deg[0] + jitter);
    config.beams[i].direction_deg[1] = static_cast<float>(config.beams[i].direction_deg[1] - jitter);
  }
  const Result<BeamGrid> grid = derive_beam_grid(config, 270.0);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->fans(), 20);
  EXPECT_EQ(grid->beams(), 25);
  EXPECT_NEAR(grid->elevation_deg[3], -45.0 + 3 * 45.0 / 19.0, 0.02);
}

TEST(BeamGrid, OtherSizes) {
  struct Size {
    int fans, beams;
  };
  for (const Size size : {Size{60, 40}, Size{1, 25}, Size{20, 1}, Size{1, 1}, Size{2, 3}}) {
    const Result<BeamGrid> grid = derive_beam_grid(regular(size.fans, size.beams), 270.0);
    ASSERT_TRUE(grid) << size.fans << " x " << size.beams;
    EXPECT_EQ(grid->fans(), size.fans);
    EXPECT_EQ(grid->beams(), size.beams);
    const Sector sector = grid->sector({0.0, 0.5, 10});
    EXPECT_EQ(sector.fans(), size.fans);
    EXPECT_GT(sector.solid_angle_sr(0, 0), 0.0);
  }
}

/// Two fans of these azimuths from abeam.
SounderConfig fans_of(const std::vector<double>& azimuths_deg) {
  SounderConfig config = regular(2, static_cast<int>(azimuths_deg.size()));
  for (std::size_t i = 0; i < config.beams.size(); ++i) {
    config.beams[i].direction_deg[1] = azimuths_deg[i % azimuths_deg.size()];
  }
  return config;
}

std::vector<double> steps(double first_deg, double last_deg, double step_deg) {
  std::vector<double> out;
  for (int i = 0; first_deg + i * step_deg <= last_deg; ++i) out.push_back(first_deg + i * step_deg);
  return out;
}

TEST(BeamGrid, AnArcThatCrossesTheLimitOf180DegreesIsShort) {
  std::vector<double> azimuths = steps(-177.5, -150.0, 2.5);                          // 12
  for (const double azimuth : steps(150.0, 180.0, 2.5)) azimuths.push_back(azimuth);  // 13
  const Result<BeamGrid> grid = derive_beam_grid(fans_of(azimuths), 270.0);
  ASSERT_TRUE(grid);
  ASSERT_EQ(grid->fans(), 2);
  ASSERT_EQ(grid->beams(), 25);
  for (int beam = 0; beam < 25; ++beam) {
    EXPECT_NEAR(grid->azimuth_deg[static_cast<std::size_t>(beam)], 420.0 + 2.5 * beam, 1e-9);
    // The table has the arc's second half first.
    EXPECT_EQ(grid->channel[static_cast<std::size_t>(beam)], beam < 13 ? beam + 12 : beam - 13);
  }
  const Sector sector = grid->sector({0.0, 0.5, 10});
  // Abeam (270) lies opposite the arc's middle (270 + 180).
  EXPECT_FALSE(sector.contains(sector.index_of({0.0, -3.0, 0.01})));
  EXPECT_TRUE(sector.contains(sector.index_of({0.0, 3.0, 0.01})));
}

TEST(BeamGrid, TheSameDirectionAsPlusAndMinus180DegreesIsOne) {
  SounderConfig config = fans_of({170.0, 175.0, 180.0, -175.0});
  config.beams[6].direction_deg[1] = -180.0;
  const Result<BeamGrid> grid = derive_beam_grid(config, 90.0);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->azimuth_deg, (std::vector<double>{260.0, 265.0, 270.0, 275.0}));
}

TEST(BeamGrid, WideArcsTurnAwayFromTheirHole) {
  // 270 degrees of water with the hole from -90 to 0.
  std::vector<double> azimuths = steps(-180.0, -90.0, 10.0);
  for (const double azimuth : steps(0.0, 170.0, 10.0)) azimuths.push_back(azimuth);
  const Result<BeamGrid> grid = derive_beam_grid(fans_of(azimuths), 270.0);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->azimuth_deg, steps(270.0, 540.0, 10.0));
  const Result<BeamGrid> two = derive_beam_grid(fans_of({-170.0, 170.0}), 0.0);
  ASSERT_TRUE(two);
  EXPECT_EQ(two->azimuth_deg, (std::vector<double>{170.0, 190.0}));
}

TEST(BeamGrid, WholeCirclesStayAsTheyAre) {
  for (const double last_deg : {170.0, 180.0}) {
    const std::vector<double> azimuths = steps(-180.0, last_deg, 10.0);
    const Result<BeamGrid> grid = derive_beam_grid(fans_of(azimuths), 270.0);
    ASSERT_TRUE(grid) << last_deg;
    EXPECT_EQ(grid->azimuth_deg, steps(90.0, last_deg + 270.0, 10.0));
  }
}

TEST(BeamGrid, WhatIsNoGridIsRefusedWithASentence) {
  const auto refused = [](const SounderConfig& config) {
    const Result<BeamGrid> grid = derive_beam_grid(config, 270.0);
    return !grid && grid.error().code == ErrorCode::unsupported && grid.error().text.size() > 20;
  };
  EXPECT_TRUE(refused(SounderConfig{}));

  SounderConfig duplicate = regular(4, 5);
  duplicate.beams[7].direction_deg = duplicate.beams[8].direction_deg;
  EXPECT_TRUE(refused(duplicate));

  SounderConfig missing = regular(4, 5);
  missing.beams.pop_back();
  EXPECT_TRUE(refused(missing));

  SounderConfig staggered = regular(4, 5);
  for (std::size_t beam = 0; beam < 5; ++beam) staggered.beams[beam].direction_deg[1] += 1.0;
  EXPECT_TRUE(refused(staggered));

  SounderConfig unusable = regular(4, 5);
  unusable.beams[3].direction_deg[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(unusable));
  unusable.beams[3].direction_deg[0] = 91.0;
  EXPECT_TRUE(refused(unusable));
}

TEST(BeamGrid, SoundersThatLookDownHaveNoGrid) {
  for (const auto& [kind, name] :
       {std::pair{SounderKind::ek60, "Simrad EK60 (ER60)"}, std::pair{SounderKind::me70, "Simrad ME70 (ER60)"},
        std::pair{SounderKind::omni, "ER60"}}) {
    SounderConfig config = regular(1, 15);
    config.kind = kind;
    config.sounder_name = "ER60";
    const Result<BeamGrid> grid = derive_beam_grid(config, 270.0);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().text,
              std::string("the beams make no product grid: ") + name + " does not look sideways in fans");
  }
}

}  // namespace
}  // namespace sonar
