// SPDX-License-Identifier: Apache-2.0
#include "school/measure/mask_inside.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "base/units.h"
#include "school/test_body.h"
#include "school/test_water.h"

namespace sonar {
namespace {

constexpr double kPulse_m = 1.5;

struct Shell {
  Sector sector = test::grid().sector(test::range_axis());
  Array3<SampleFlags> flags{Shape3{20, 25, 900}};
  Point<Sonar> centre = Sector::direction(rad_from_deg(-22.0), rad_from_deg(268.0)) * 120.0;

  [[nodiscard]] PingMask mask(double inner_m, double hole_m = 0.0) const {
    return test::body_mask(sector, [&](const Point<Sonar>& p) {
      const Point<Sonar> d = p - centre;
      const bool in_hole = d.x > 0.0 && std::hypot(d.y, d.z) < hole_m;
      return norm(d) < 30.0 && norm(d) >= inner_m && !in_hole;
    });
  }
  [[nodiscard]] EnclosedWater inside(const PingMask& mask) const {
    return enclosed_water(mask, std::as_const(flags).view(), sector, kPulse_m);
  }
};

TEST(EnclosedWater, OfAHollowBallIsTheHollow) {
  const Shell shell;
  const EnclosedWater inside = shell.inside(shell.mask(14.0));
  EXPECT_EQ(inside.vacuoles, 1);
  EXPECT_NEAR(inside.vacuoles_m3 / (4.0 / 3.0 * std::numbers::pi * 14.0 * 14.0 * 14.0), 1.0, 0.05);
  EXPECT_DOUBLE_EQ(inside.vacuoles_m3, inside.volume_m3);
  EXPECT_EQ(shell.inside(shell.mask(0.0)).vacuoles, 0);
  EXPECT_TRUE(shell.inside(shell.mask(0.0)).runs.empty());
}

TEST(EnclosedWater, IsNoneWhereItIsOpenToOutside) {
  const Shell shell;
  EXPECT_EQ(shell.inside(shell.mask(14.0, 8.0)).vacuoles, 0) << "a way out through the wall";
  Shell seabed;
  const PingMask mask = seabed.mask(14.0);
  const SectorIndex at = seabed.sector.index_of(seabed.centre);
  const int row = static_cast<int>(at.fan + 0.5) * 25 + static_cast<int>(at.beam + 0.5);
  seabed.flags.view().row(row)[static_cast<std::size_t>(at.sample)] |= SampleFlags::seabed;
  EXPECT_EQ(seabed.inside(mask).vacuoles, 0) << "not known to be water";
}

TEST(EnclosedWater, WhatIsShorterThanThePulseIsNoVacuole) {
  const Shell shell;
  PingMask mask = shell.mask(0.0);
  PingMask gap;
  for (const sonar::Run& run : mask.runs) {
    if (run.row == 10 * 25 + 11 && run.count > 30) gap.runs = {{run.row, run.first_sample + 10, 3}};
  }
  ASSERT_EQ(gap.runs.size(), 1U);
  gap.confidence.assign(3, 255);
  EXPECT_EQ(shell.inside(subtract(mask, gap)).vacuoles, 0);
  EXPECT_EQ(shell.inside(subtract(mask, gap)).runs, gap.runs);
  gap.runs[0].count = 4;  // 4 x 0.3776 m > 1.5 m
  gap.confidence.assign(4, 255);
  EXPECT_EQ(shell.inside(subtract(mask, gap)).vacuoles, 1);
}

TEST(EnclosedWater, TwoHollowsAreTwo) {
  const Shell shell;
  const PingMask mask = test::body_mask(shell.sector, [&](const Point<Sonar>& p) {
    const Point<Sonar> d = p - shell.centre;
    const Point<Sonar> off{14.0, 0.0, 0.0};
    return norm(d) < 30.0 && norm(d - off) > 8.0 && norm(d + off) > 8.0;
  });
  EXPECT_EQ(shell.inside(mask).vacuoles, 2);
}

// A brick of 5 fans, 6 beams and 30 samples with a dent in one corner.
TEST(CoreRuns, AreTheBodyWithoutItsOutermostCells) {
  std::vector<sonar::Run> brick;
  for (int fan = 4; fan < 9; ++fan) {
    for (int beam = 10; beam < 16; ++beam) brick.push_back({fan * 25 + beam, fan == 5 && beam == 12 ? 120 : 100, 30});
  }
  const std::vector<sonar::Run> core = core_runs(brick, Shape3{20, 25, 900}, 4);
  std::int64_t voxels = 0;
  for (const sonar::Run& run : core) voxels += run.count;
  // 3 fans x 4 beams x 22; the dented row has 124..129 left within its neighbours' 100..129, and these have 120..125 left
  // of 104..125: (5, 11) and (5, 13) in the same fan, (6, 12) above; (4, 12) is outermost anyhow
  EXPECT_EQ(core.size(), 12U);
  EXPECT_EQ(voxels, 12 * 22 - 3 * 16 - (22 - 6));
  EXPECT_TRUE(core_runs({{10 * 25 + 7, 100, 50}}, Shape3{20, 25, 900}, 4).empty());
}

}  // namespace
}  // namespace sonar
