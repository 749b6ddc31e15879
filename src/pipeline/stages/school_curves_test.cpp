// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/school_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "base/units.h"
#include "pipeline/stages/test_fans.h"

namespace sonar {
namespace {

constexpr Shape3 kShape = test::kFans;

Sector sector() { return test::fans_sector(); }

std::int16_t count(double sv_db) { return static_cast<std::int16_t>(std::lround(counts_from_db(sv_db))); }

/// Uniform water at -70.5 dB over a background of -80 dB, with a pyramid in beam 4 of fan 1 about sample 30 whose Sv falls
/// by 1 dB a sample from -40.5 dB.
struct Scene {
  StagedPing ping;
  FilteredPing filtered;
  Scene() {
    ping.sv = {Array3<std::int16_t>(kShape), Array3<SampleFlags>(kShape)};
    for (std::int16_t& one : ping.sv.counts.all()) one = count(-70.5);
    for (int s = 10; s <= 50; ++s) ping.sv.counts(1, 4, s) = count(-40.5 - std::abs(s - 30));
    Array3<std::int16_t> table(kShape);
    for (std::int16_t& one : table.all()) one = count(20.0);
    ping.calibration = std::make_shared<const Array3<std::int16_t>>(std::move(table));
    ping.background_db.assign(kShape.rows(), -100.0);
    ping.filtered = std::make_shared<Volume>(ping.sv);
    filtered.volume = ping.filtered;
  }
};

PingMask mask_of(std::vector<Run> runs) { return test::mask_of(std::move(runs), 255); }

// Two samples of one beam: cells of (r2^3 - r1^3) / 3 sr, centres at 35 and 35.5 m, so 35^2 + 1/48 to 35.5^2 + 1/48.
TEST(SvHistograms, SharesAreOfVolumeNotOfSamples) {
  Scene scene;
  SvHistogram told;
  told.add(mask_of({{13, 30, 2}}), scene.ping, sector());
  const double near = 35.0 * 35.0 + 1.0 / 48.0;
  const double far = 35.5 * 35.5 + 1.0 / 48.0;
  EXPECT_NEAR(told.share(-41), near / (near + far), 1e-9) << "-40.5 dB";
  EXPECT_NEAR(told.share(-42), far / (near + far), 1e-9) << "-41.5 dB";
  EXPECT_EQ(told.share(-40), 0.0);
  const double mean = (near * std::pow(10.0, -4.05) + far * std::pow(10.0, -4.15)) / (near + far);
  EXPECT_NEAR(told.mean_db(), 10.0 * std::log10(mean), 0.01) << "counts are rounded";
  EXPECT_NEAR(told.background_db(), -80.0, 0.01);
}

TEST(SvHistograms, OfABoxInUniformWaterAreOneBinEach) {
  Scene scene;
  const PingMask box = mask_of({{12, 20, 10}, {13, 20, 10}, {14, 20, 10}});
  for (const sonar::Run& run : box.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) {
      scene.ping.sv.counts(run.row / 9, run.row % 9, s) = count(-50.5);
    }
  }
  scene.ping.sv.flags(1, 4, 22) = SampleFlags::interference;
  scene.ping.sv.counts(1, 4, 22) = count(0.0);
  scene.ping.sv.counts(1, 4, 24) = kNoData;
  SvHistogram inside;
  inside.add(box, scene.ping, sector());
  ASSERT_EQ(inside.volume_m3.size(), 1U) << "faults and gaps take no part";
  EXPECT_NEAR(inside.share(-51), 1.0, 1e-12);
  SvHistogram outside;
  outside.add(mask_of({{10, 20, 10}, {16, 20, 10}}), scene.ping, sector());
  EXPECT_NEAR(outside.share(-71), 1.0, 1e-12);
  SvHistogram both = inside;
  both.add(outside);
  EXPECT_NEAR(both.share(-51), inside.heard_m3 / (inside.heard_m3 + outside.heard_m3), 1e-12);
}

// With a tolerance of t dB the pyramid has 2 floor(t) + 1 samples until the water, 30 dB below its top, is let in.
TEST(GrowthSensitivity, TakesInWhatThePyramidHasAtEachTolerance) {
  const Scene scene;
  const GrowthStart start{{{13, 30}}, 10.5, 0.0, Connectivity::faces};
  const std::vector<double> changes{-12.0, -6.0, -1.0, 0.0, 1.0, 6.0, 25.0};
  const auto told = growth_sensitivity(start, scene.ping, scene.filtered, {}, sector(), changes, [] { return true; });
  ASSERT_TRUE(told);
  ASSERT_EQ(told->size(), changes.size());
  const std::vector<std::int64_t> expected{0, 9, 19, 21, 23, 33, 3 * 9 * 60};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ((*told)[i].echo.voxels, expected[i]) << changes[i];
    EXPECT_EQ((*told)[i].tolerance_db, 10.5 + changes[i]);
    if (i > 0) {
      EXPECT_GE((*told)[i].echo.volume_m3, (*told)[i - 1].echo.volume_m3);
    }
  }
  // Of the 21 samples those of the others are taken away.
  const PingMask others = mask_of({{13, 38, 10}});
  const auto beside =
      growth_sensitivity(start, scene.ping, scene.filtered, others, sector(), std::vector{0.0}, [] { return true; });
  EXPECT_EQ(beside->front().echo.voxels, 18);
  int asked = 0;
  const auto stopped =
      growth_sensitivity(start, scene.ping, scene.filtered, {}, sector(), changes, [&] { return ++asked < 3; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_EQ(asked, 3);
}

TEST(GrowthSensitivity, WithoutAClickBeginsAtTheStrongestVoxel) {
  const Scene scene;
  const auto start = start_at_strongest(mask_of({{13, 25, 10}}), -50.5, *scene.ping.filtered, {});
  ASSERT_TRUE(start);
  EXPECT_EQ(start->seeds, (std::vector<VoxelIndex>{{13, 30}}));
  EXPECT_NEAR(start->tolerance_db, 10.0, 0.01);
  EXPECT_FALSE(start_at_strongest(mask_of({{13, 25, 10}}), std::nan(""), *scene.ping.filtered, {}));
  EXPECT_FALSE(start_at_strongest(mask_of({{13, 25, 10}}), -30.0, *scene.ping.filtered, {}));
}

// Backscatter of 8, 9.5, 10, 11, 13 and 9: 1 dB is a factor of 1.26 either way, 7.94 to 12.59; what comes back to it later is
// no part of the plateau.
TEST(GrowthSensitivity, ThePlateauEndsWhereTheBackscatterFirstLeaves) {
  std::vector<GrownSize> sizes;
  for (const auto& [change, echo] :
       std::vector<std::pair<double, double>>{{-3, 5}, {-2, 8}, {-1, 9.5}, {0, 10}, {1, 11}, {2, 13}, {3, 9}}) {
    sizes.push_back({change, 10.0 + change, {}});
    sizes.back().echo.backscatter_m2 = echo;
  }
  EXPECT_EQ(plateau(sizes, 1.0), (std::pair{-2.0, 1.0}));
  sizes.erase(sizes.begin() + 3);
  EXPECT_FALSE(plateau(sizes, 1.0));
}

}  // namespace
}  // namespace sonar
