// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/fan_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <tuple>

#include "base/units.h"
#include "pipeline/stages/test_fans.h"

namespace sonar {
namespace {

constexpr Shape3 kShape = test::kFans;

Sector sector() { return test::fans_sector(); }

/// A ping that is a little different in every sample, with noise of its own in each beam.
std::shared_ptr<StagedPing> uneven() {
  auto ping = std::make_shared<StagedPing>();
  ping->sv = {Array3<std::int16_t>(kShape), Array3<SampleFlags>(kShape)};
  Array3<std::int16_t> table(kShape);
  std::size_t i = 0;
  for (std::int16_t& count : ping->sv.counts.all()) {
    count = static_cast<std::int16_t>(-4000 + static_cast<int>((i * 7919) % 701));
    table.all()[i] = static_cast<std::int16_t>(1000 + static_cast<int>(i % 60) * 10);
    ++i;
  }
  for (std::size_t row = 0; row < kShape.rows(); ++row)
    ping->background_db.push_back(-90.0 + static_cast<double>(row) * 0.5);
  ping->calibration = std::make_shared<const Array3<std::int16_t>>(std::move(table));
  ping->filtered = std::make_shared<Volume>(ping->sv);
  return ping;
}

PingMask mask_of(std::vector<Run> runs) { return test::mask_of(std::move(runs), 200); }

/// A school in the two lower fans, with a fault in it.
struct Case {
  std::shared_ptr<StagedPing> ping = uneven();
  PingMask mask = mask_of({{3, 20, 10}, {4, 18, 15}, {9 + 4, 22, 8}, {9 + 5, 22, 3}, {9 + 5, 27, 2}});
  Case() {
    for (Volume* volume : {&ping->sv, ping->filtered.get()}) {
      volume->flags(0, 4, 20) = SampleFlags::interference;
      volume->flags(1, 4, 23) = SampleFlags::dropout;
    }
    ping->sv.counts(0, 3, 21) = kNoData;
  }
};

// The sum anew, voxel by voxel: 10^(Sv/10) less 10^(noise/10), times the cell's volume (r2^3 - r1^3)/3 (sin e2 - sin e1)
// (a2 - a1).
TEST(HeardFans, AreSumsOverTheVoxelsOfEachFan) {
  const Case one;
  const Sector sonar = sector();
  std::array<double, 3> echo{};
  std::array<double, 3> volume{};
  std::array<std::int64_t, 3> samples{};
  constexpr double kDb = 10.0 * std::numbers::ln2 / std::numbers::ln10 / 256.0;  // of a count
  for (const sonar::Run& run : one.mask.runs) {
    const int fan = run.row / 9;
    const int beam = run.row % 9;
    for (int s = run.first_sample; s < run.first_sample + run.count; ++s) {
      const std::int16_t count = one.ping->sv.counts(fan, beam, s);
      if (count == kNoData || one.ping->sv.flags(fan, beam, s) != SampleFlags::none) continue;
      const double noise_db = -90.0 + 0.5 * run.row + kDb * (1000 + s * 10);
      const double sv = std::pow(10.0, kDb * count / 10.0) - std::pow(10.0, noise_db / 10.0);
      const double near = 20.0 + 0.5 * (s - 0.5);
      const double far = near + 0.5;
      const double e = std::numbers::pi / 180.0 * (-30.0 + 10.0 * fan);
      const double half = std::numbers::pi / 180.0 * 5.0;
      const double cell = (far * far * far - near * near * near) / 3.0 * (std::sin(e + half) - std::sin(e - half)) *
                          (std::numbers::pi / 180.0 * 3.0);
      echo[static_cast<std::size_t>(fan)] += sv * cell;
      volume[static_cast<std::size_t>(fan)] += cell;
      ++samples[static_cast<std::size_t>(fan)];
    }
  }
  const auto told = heard_fans(one.mask, *one.ping, sonar);
  ASSERT_EQ(told.size(), 2U) << "nothing of it lies in the upper fan";
  for (std::size_t i = 0; i < told.size(); ++i) {
    const auto fan = static_cast<std::size_t>(told[i].fan);
    EXPECT_EQ(fan, i);
    EXPECT_EQ(told[i].samples, samples[fan]);
    EXPECT_NEAR(told[i].volume_m3, volume[fan], 1e-9 * volume[fan]);
    EXPECT_NEAR(told[i].mean_sv_per_m, echo[fan] / volume[fan], 1e-9 * std::abs(echo[fan] / volume[fan]));
  }
}

TEST(WaterRound, IsNextToTheSchoolInItsFansAndNothingElse) {
  Case one;
  one.ping->filtered->flags(0, 5, 50) = SampleFlags::seabed;
  const PingMask other = mask_of({{6, 25, 4}});  // in the lower fan, three beams off
  const std::array<const PingMask*, 2> all{&one.mask, &other};
  const PingMask water = water_round(one.mask, all, *one.ping, sector(), {3, 8.0, 1, 1.0});
  std::set<std::tuple<int, int, int>> told;
  for (const sonar::Run& run : water.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) EXPECT_TRUE(told.insert({run.row / 9, run.row % 9, s}).second);
  }
  EXPECT_EQ(water.voxels(), told.size());
  // By hand: 8 m are 16 samples, 1 m is 2. In the lower fan beams 3 to 4, samples 18 to 32; in the next 4 to 5, 22 to 29.
  const auto near_a_run = [](const PingMask& mask, int fan, int beam, int s) {
    return std::any_of(mask.runs.begin(), mask.runs.end(), [&](const sonar::Run& run) {
      return run.row / 9 == fan && std::abs(run.row % 9 - beam) <= 1 && s >= run.first_sample - 2 && s < run.end() + 2;
    });
  };
  for (int fan = 0; fan < 3; ++fan) {
    for (int beam = 0; beam < 9; ++beam) {
      for (int s = 0; s < 60; ++s) {
        const bool in_box = (fan == 0 && beam >= 0 && beam <= 7 && s >= 2 && s < 33 + 16) ||
                            (fan == 1 && beam >= 1 && beam <= 8 && s >= 6 && s < 30 + 16);
        const bool sound = one.ping->sv.counts(fan, beam, s) != kNoData &&
                           one.ping->filtered->flags(fan, beam, s) == SampleFlags::none;
        const bool expected =
            in_box && sound && !near_a_run(one.mask, fan, beam, s) && !near_a_run(other, fan, beam, s);
        EXPECT_EQ(told.contains({fan, beam, s}), expected) << fan << " " << beam << " " << s;
      }
    }
  }
}

// By hand: two pings of 1e-4 in 10 m3 and 4e-4 in 30 m3 are 3.25e-4 per metre together.
TEST(FanResponses, AreLinearMeansWeightedByVolumeWithQuartilesOfPings) {
  const std::vector<std::vector<HeardFan>> two{{{2, 5, 10.0, 1e-4}}, {{2, 7, 30.0, 4e-4}, {4, 1, 1.0, -1e-9}}};
  const auto told = fan_response(two);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].fan, 2);
  EXPECT_EQ(told[0].pings, 2);
  EXPECT_EQ(told[0].samples, 12);
  EXPECT_DOUBLE_EQ(told[0].volume_m3, 40.0);
  EXPECT_NEAR(told[0].sv_mean_db, 10.0 * std::log10(3.25e-4), 1e-9);
  EXPECT_TRUE(std::isnan(told[0].sv_p25_db)) << "of two pings there are no quartiles";
  EXPECT_TRUE(std::isnan(told[1].sv_mean_db)) << "not above the background";
  std::vector<std::vector<HeardFan>> eight;
  for (int i = 8; i > 0; --i) eight.push_back({{0, 1, 1.0, i * 1e-5}});
  const auto quartiles = fan_response(eight);
  EXPECT_NEAR(quartiles[0].sv_p25_db, 10.0 * std::log10(2e-5), 1e-9) << "the second of eight";
  EXPECT_NEAR(quartiles[0].sv_p75_db, 10.0 * std::log10(6e-5), 1e-9) << "the sixth";
  std::reverse(eight.begin(), eight.end());
  EXPECT_EQ(fan_response(eight)[0].sv_p25_db, quartiles[0].sv_p25_db);
}

}  // namespace
}  // namespace sonar
