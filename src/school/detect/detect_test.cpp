// SPDX-License-Identifier: Apache-2.0
#include "school/detect/detect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "model/school.h"
#include "school/measure/edges.h"
#include "school/test_scene.h"

namespace sonar {
namespace {

using test::Scene;

double volume(const PingMask& mask, const Sector& sector) { return shape_of(mask, sector).volume_m3; }

TEST(Detect, FindsAnEllipsoid) {
  for (const double range_m : {100.0, 200.0, 300.0}) {
    double dice_sum = 0.0;
    double volume_sum = 0.0;
    double truth_sum = 0.0;
    // where the school lies between the beams makes one ping's cells more or fewer than the truth's
    for (const double elevation_deg : {-21.0, -18.0, -15.5, -12.3}) {
      Scene scene;
      scene.add(range_m, elevation_deg, 268.0 + elevation_deg / 5.0, -40.0);
      const std::vector<Detection> found = scene.look(static_cast<std::uint64_t>(range_m - elevation_deg));
      ASSERT_EQ(found.size(), 1U) << range_m;
      EXPECT_EQ(found[0].edge_flags, 0);
      dice_sum += dice(found[0].mask, scene.truths[0]);
      volume_sum += found[0].volume_m3;
      truth_sum += volume(scene.truths[0], scene.sector);
    }
    // the aim of the project: Dice 0.85, apparent volume within 20 %
    EXPECT_GT(dice_sum / 4.0, 0.85) << range_m;
    EXPECT_NEAR(volume_sum / truth_sum, 1.0, 0.2) << range_m;
  }
}

TEST(Detect, FindsNothingInNoise) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) EXPECT_TRUE(Scene().look(seed).empty());
}

// Gusts: the mean of each patch of water varies, so that the filter leaves more of the noise than of plain fading.
TEST(Detect, NoiseOfHeavyTailsHoldsNoSchoolAndHidesNone) {
  DetectParams eager;
  eager.false_alarm = 6.0;
  for (const bool with_school : {false, true}) {
    Scene scene;
    scene.alone = true;
    if (with_school) scene.add(180.0, -18.0, 268.0, -38.0);
    scene.reverberation = [](std::uint64_t ping, int row, int s) {
      const int patch = ((row / 25 / 3) * 25 + row % 25 / 3) * 900 + s / 20;
      return linear_from_db(-65.0) *
             -std::log(test::uniform(977 + 1'000'000 * ping + static_cast<std::uint64_t>(patch)));
    };
    std::fill(scene.flat.power_db.begin(), scene.flat.power_db.end(), -67.0);
    const std::vector<Detection> found = scene.look(8, eager);
    ASSERT_EQ(found.size(), with_school ? 1U : 0U);
    for (const Detection& school : found) EXPECT_GT(dice(school.mask, scene.truths[0]), 0.75);
  }
}

// Reverberation is background too, at whatever range it is loud: alone it holds no school, and a school in it is found
// as large as the school is.
TEST(Detect, ReverberationIsNoSchoolAndHidesNone) {
  for (const bool steep : {false, true}) {
    Scene scene;
    scene.add(180.0, -18.0, 268.0, -42.0);
    Scene alone;
    for (Scene* one : {&scene, &alone}) {
      for (int row = 0; row < 500; ++row) {
        for (int s = 40; s < 900; ++s) {
          const double r = one->sector.range().range_m(s);
          const double sv_db = steep ? -62.0 - 20.0 * std::log10(r / 100.0) : -58.0;
          one->expected.view().row(row)[static_cast<std::size_t>(s)] += linear_from_db(sv_db);
        }
      }
    }
    EXPECT_TRUE(alone.look(5).empty()) << steep;
    const std::vector<Detection> found = scene.look(6);
    ASSERT_EQ(found.size(), 1U) << steep;
    EXPECT_NEAR(volume(found[0].mask, scene.sector) / volume(scene.truths[0], scene.sector), 1.0, 0.35) << steep;
  }
}

// At 80 m a long school fills all beams of its fans as the ship goes by: that is no property of the water.
TEST(Detect, ASchoolThatFillsItsFansIsNoWater) {
  Scene scene;
  scene.alone = true;
  scene.add(90.0, -20.0, 270.0, -45.0, {45, 12, 8});
  const std::vector<Detection> found = scene.look(7);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(dice(found[0].mask, scene.truths[0]), 0.8);
}

TEST(Detect, KeepsWeakBesideStrong) {
  Scene scene;
  scene.add(150.0, -15.0, 255.0, -35.0);
  scene.add(190.0, -15.0, 272.0, -52.0);
  const std::vector<Detection> found = scene.look(5);
  ASSERT_EQ(found.size(), 2U);
  for (const PingMask& truth : scene.truths) {
    const double best = std::max(dice(found[0].mask, truth), dice(found[1].mask, truth));
    EXPECT_GT(best, 0.8);
  }
  EXPECT_EQ(overlap(found[0].mask, found[1].mask), 0U);
}

TEST(Detect, BridgesCorruptedPackets) {
  Scene scene;
  scene.add(150.0, -18.0, 265.0, -40.0, {16, 9, 6});
  const int row = 11 * 25 + 10;
  for (int s = 300; s < 600; ++s) scene.flags.view().row(row)[static_cast<std::size_t>(s)] |= SampleFlags::corrupted;
  const std::vector<Detection> found = scene.look(3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(dice(found[0].mask, scene.truths[0]), 0.85);
  PingMask stripe;
  stripe.runs = {{row, 300, 300}};
  stripe.confidence.assign(300, 1);
  EXPECT_GT(overlap(found[0].mask, stripe), 0U);
}

TEST(Detect, RefusesInterferenceAndABeam) {
  Scene scene;
  for (int row = 0; row < 500; ++row) {  // interference that nobody flagged: 15 samples thick in all beams
    for (int s = 500; s < 515; ++s) scene.expected.view().row(row)[static_cast<std::size_t>(s)] = 1e-4;
  }
  for (int s = 300; s < 450; ++s) scene.expected(9, 9, s) = 1e-3;  // one beam
  EXPECT_TRUE(scene.look(1).empty());
}

// A ball so near that it fills many beams has its middles at nearly one range too: by half its angular radius squared.
TEST(Detect, FindsSchoolsThatFillManyBeams) {
  for (const double range_m : {40.0, 60.0, 100.0}) {
    Scene scene;
    scene.alone = true;
    scene.add(range_m, -22.0, 270.0, -40.0, {0.3 * range_m, 0.3 * range_m, 0.3 * range_m});
    const std::vector<Detection> found = scene.look(1);
    ASSERT_EQ(found.size(), 1U) << range_m;
    EXPECT_GE(found[0].box.beams(), 8);
    EXPECT_GE(found[0].box.fans(), 8);
  }
  // A long thin one across the beams, at right angles to the middle one, bends by the square of its angle.
  Scene scene;
  scene.alone = true;
  scene.add(120.0, -15.0, 270.0, -40.0, {40.0, 3.0, 3.0});
  const std::vector<Detection> found = scene.look(2);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GE(found[0].box.beams(), 8);
}

TEST(Detect, LeavesOthersVoxelsAlone) {
  Scene scene;
  scene.add(150.0, -18.0, 265.0, -40.0);
  const auto found = scene.look(1, {}, &scene.truths[0]);
  for (const Detection& d : found) EXPECT_EQ(overlap(d.mask, scene.truths[0]), 0U);
}

// INTERFACES: f falls as 1 - (d/t)^2 to 0 at the threshold, d and t in dB below the reference.
TEST(Detect, ConfidenceFallsToNothingAtTheThresholdThatIsPublished) {
  const DetectParams params{.tolerance_db = 20.0};
  for (const double weak_db : {-45.0, -50.0, -55.0}) {
    for (const double apart_deg : {9.0, 11.0, 13.0, 15.0}) {
      Scene scene;
      scene.add(150.0, -15.0, 262.0, -35.0);
      scene.add(150.0, -15.0, 262.0 + apart_deg,
                weak_db);  // stands in the stronger one's skirt, which may raise its threshold
      for (const Detection& d : scene.look(static_cast<std::uint64_t>(10.0 * apart_deg), params)) {
        const double t = d.reference_db - d.threshold_db;
        std::size_t i = 0;
        for (const sonar::Run& run : d.mask.runs) {
          for (int s = run.first_sample; s < run.end(); ++s, ++i) {
            const double below = d.reference_db - db_from_counts(scene.along_beam(run.row, s, kMemberSamples));
            const double f = below > 0.0 ? 1.0 - below * below / (t * t) : 1.0;
            ASSERT_NEAR(d.mask.confidence[i], std::max(1.0, 255.0 * f), 0.51) << below << " of " << t;
          }
        }
      }
    }
  }
}

// The box of three beams takes most of a school of two beams away, and what is left of it tells neither where the echo
// is 10 dB below the strongest, nor how much of it is noise.
TEST(Detect, SmallAndWeakSchoolsAreAsLargeAsTheyAre) {
  for (const double above_noise_db : {40.0, 22.0, 16.0}) {
    Scene scene;
    scene.add(220.0, -18.0, 266.0, -40.0, {11, 7, 4});
    const double peak = *std::max_element(scene.expected.all().begin(), scene.expected.all().end());
    const double noise_db = db_from_linear(peak) - above_noise_db;
    for (double& sv : scene.expected.all()) sv += linear_from_db(noise_db);
    std::fill(scene.flat.power_db.begin(), scene.flat.power_db.end(), noise_db);
    const auto found = scene.look(21);
    ASSERT_EQ(found.size(), 1U) << above_noise_db;
    EXPECT_GT(dice(found[0].mask, scene.truths[0]), 0.85) << above_noise_db;
    EXPECT_NEAR(volume(found[0].mask, scene.sector) / volume(scene.truths[0], scene.sector), 1.0, 0.2)
        << above_noise_db;
  }
}

TEST(Detect, SeabedIsNoMember) {
  Scene scene;
  scene.add(150.0, -18.0, 265.0, -40.0);
  for (int row = 0; row < 500; ++row) {
    for (int s = 400; s < 900; ++s) scene.flags.view().row(row)[static_cast<std::size_t>(s)] |= SampleFlags::seabed;
  }
  for (const Detection& d : scene.look(1)) EXPECT_LT(d.box.last_sample, 400);
}

TEST(Edges, NamesEachBorder) {
  const Sector sector = test::grid().sector(test::range_axis(100));
  const Array3<SampleFlags> flags = test::cropped_flags({20, 25, 100}, sector);
  const auto edges = [&](int row, int first, int count) {
    PingMask mask;
    mask.runs = {{row, first, count}};
    mask.confidence.assign(static_cast<std::size_t>(count), 255);
    return mask_edges(mask, flags.view(), sector);
  };
  EXPECT_EQ(edges(10 * 25 + 10, 60, 5).flags, 0);
  EXPECT_EQ(edges(10 * 25 + 24, 60, 5).flags, kEdgeFore);  // port: the largest azimuth looks forward
  EXPECT_EQ(edges(10 * 25, 60, 5).flags, kEdgeAft);
  EXPECT_EQ(edges(19 * 25 + 3, 60, 5).flags, kEdgeTopFan);
  EXPECT_EQ(edges(3, 60, 5).flags, kEdgeBottomFan);
  EXPECT_EQ(edges(10 * 25 + 3, 95, 5).flags, kEdgeFar);
  EXPECT_EQ(edges(10 * 25 + 3, 42, 5).flags, kEdgeNear);  // 15 m = sample 41.7
  // by hand: 5 voxels in a row have 5 x 4 sides and 2 ends; 5 sides lie at the border
  EXPECT_DOUBLE_EQ(edges(10 * 25, 60, 5).edge_fraction, 5.0 / 22.0);
}

TEST(Edges, ForeAndAftChangeSidesWithTheMounting) {
  const Sector sector = test::grid(90.0).sector(test::range_axis(100));
  const Array3<SampleFlags> flags({20, 25, 100});
  PingMask mask;
  mask.runs = {{10 * 25, 60, 5}};
  mask.confidence.assign(5, 255);
  EXPECT_EQ(mask_edges(mask, flags.view(), sector).flags, kEdgeFore);
}

TEST(Edges, CropsAreBorders) {
  const Sector sector = test::grid().sector(test::range_axis(100));
  Array3<SampleFlags> flags({20, 25, 100});
  for (SampleFlags& flag : flags.all().subspan(19 * 25 * 100)) flag = SampleFlags::surface;
  for (int s = 96; s < 100; ++s) flags(10, 10, s) = SampleFlags::dropout;
  flags(5, 6, 60) = SampleFlags::corrupted;
  PingMask top;
  top.runs = {{18 * 25 + 10, 60, 5}};
  top.confidence.assign(5, 255);
  EXPECT_EQ(mask_edges(top, flags.view(), sector).flags, kEdgeTopFan | kEdgeSurface);
  PingMask end;
  end.runs = {{10 * 25 + 10, 90, 6}};
  end.confidence.assign(6, 255);
  EXPECT_EQ(mask_edges(end, flags.view(), sector).flags, kEdgeFar);
  // A channel that was lost altogether has no end: beside it, and in it, lie faulty samples, wherever that is.
  for (int s = 0; s < 100; ++s) flags(10, 14, s) = SampleFlags::dropout;
  PingMask lost{{{10 * 25 + 14, 50, 4}}, {255, 255, 255, 255}};
  EXPECT_EQ(mask_edges(lost, flags.view(), sector).flags, kEdgeFlagged);
  lost.runs[0].row = 10 * 25 + 13;
  EXPECT_EQ(mask_edges(lost, flags.view(), sector).flags, kEdgeFlagged);
  PingMask beside;
  beside.runs = {{5 * 25 + 5, 60, 1}};
  beside.confidence.assign(1, 255);
  EXPECT_EQ(mask_edges(beside, flags.view(), sector).flags, kEdgeFlagged);
  EXPECT_EQ(mask_edges(beside, flags.view(), sector).edge_fraction, 0.0);
}

}  // namespace
}  // namespace sonar
