// SPDX-License-Identifier: Apache-2.0
#include "school/steady_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "school/detect.h"
#include "school/test_ball.h"
#include "school/test_water.h"

namespace sonar {
namespace {

/// Pings of a ship that passes a ball; in some the mask holds more than the ball.
struct Passage {
  explicit Passage(const std::vector<PingMask>& more,
                   const test::Ball& ball = {{-200.0, 60.0, -100.0}, {0.4, 0.3, 0.0}, 25.0}) {
    const Geographic start{60.0, 4.0};
    for (int p = 0; p < static_cast<int>(more.size()); ++p) {
      DetectedPing ping{p, p * 5 * kSecondNs, test::ship_at(p), {}};
      whole.push_back(test::ball_mask(ball, sector, ping.placement, start, p * test::kInterval_s));
      const PingMask& extra = more[static_cast<std::size_t>(p)];
      PingMask seen = extra.empty() ? whole.back() : unite(whole.back(), extra);
      ping.detections.push_back(describe_mask(std::move(seen), flags.view(), sector));
      pings.push_back(std::move(ping));
      school.pings.push_back({p, {0}, {}});
    }
    steady_masks(school, pings, sector);
  }
  [[nodiscard]] PingMask mask(std::size_t p) const { return mask_of(school.pings[p], pings[p]); }

  Sector sector = test::grid().sector(test::range_axis());
  Array3<SampleFlags> flags{{20, 25, 900}};
  std::vector<PingMask> whole;
  std::vector<DetectedPing> pings;
  SchoolTrack school;
};

/// Three fans of four beams, 30 samples each, beside where the ball is.
PingMask water_beside(int first_beam) {
  PingMask mask;
  for (int fan = 8; fan < 11; ++fan) {
    for (int beam = first_beam; beam < first_beam + 4; ++beam) mask.runs.push_back({fan * 25 + beam, 560, 30});
  }
  mask.confidence.assign(360, 1);
  return mask;
}

TEST(SteadyMasks, WhatOnePingAloneHoldsGoes) {
  const PingMask beside = water_beside(18);
  const Passage passage({{}, {}, {}, beside, {}, {}, {}});
  EXPECT_EQ(overlap(passage.mask(3), beside), 0U);
  EXPECT_GT(overlap(passage.pings[3].detections[0].mask, beside), 300U);
}

// Rounding to voxels on the way to the other pings costs some of the outermost ones at most.
TEST(SteadyMasks, TheSchoolStays) {
  const Passage passage({{}, {}, {}, {}, {}, {}, {}});
  for (std::size_t p = 0; p < passage.whole.size(); ++p) {
    EXPECT_GT(dice(passage.mask(p), passage.whole[p]), 0.97) << p;
  }
}

TEST(SteadyMasks, WhatMostPingsHoldStays) {
  const PingMask grown = water_beside(10);
  const Passage still({grown, grown, grown, grown, grown, grown, grown}, {{-200.0, 60.0, -100.0}, {0.0, 3.0, 0.0}});
  EXPECT_GT(overlap(still.mask(3), grown), 250U) << "it goes with the ship, as the ball does";
}

TEST(SteadyMasks, TwoSightsTellNothingOfEachOther) {
  const PingMask beside = water_beside(18);
  const Passage passage({{}, beside});
  EXPECT_EQ(passage.mask(1), passage.pings[1].detections[0].mask);
}

}  // namespace
}  // namespace sonar
