// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/noise_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

constexpr Shape3 kShape{1, 2, 8};

std::int16_t counts(double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); }

/// Two beams of eight samples. Unfiltered Sv is -40 dB everywhere but where nothing was recorded; filtered Sv is -50 dB in
/// the first beam and -43 dB in the second. Of beam 0: sample 0 is near field, 1 interference, 2 impulse noise and seabed, 3
/// not recorded, 4 behind the seabed, 5 both near field and interference. The second beam's noise is at -45 dB.
std::shared_ptr<const StagedPing> by_hand() {
  auto ping = std::make_shared<StagedPing>();
  ping->sv = {Array3<std::int16_t>(kShape, counts(-40.0)), Array3<SampleFlags>(kShape)};
  ping->sv.counts(0, 0, 3) = kNoData;
  auto& flags = ping->sv.flags;
  flags(0, 0, 0) = SampleFlags::near_field;
  flags(0, 0, 1) = SampleFlags::interference;
  flags(0, 0, 2) = SampleFlags::impulse;
  flags(0, 0, 3) = SampleFlags::dropout;
  flags(0, 0, 5) = SampleFlags::near_field | SampleFlags::interference;
  ping->filtered = std::make_shared<Volume>(Volume{Array3<std::int16_t>(kShape, counts(-50.0)), flags});
  for (int s = 0; s < 8; ++s) ping->filtered->counts(0, 1, s) = counts(-43.0);
  ping->filtered->counts(0, 0, 0) = ping->filtered->counts(0, 0, 5) = kNoData;  // where the median has none
  ping->filtered->flags(0, 0, 2) |= SampleFlags::seabed;
  ping->filtered->flags(0, 0, 4) = SampleFlags::seabed;
  ping->calibration = std::make_shared<const Array3<std::int16_t>>(Array3<std::int16_t>(kShape));  // power = Sv
  ping->background_db = {-70.0, -42.0};  // below the filtered first beam, above the second
  return ping;
}

std::size_t at(int beam, int sample) { return static_cast<std::size_t>(beam * kShape.samples + sample); }

TEST(NoiseSteps, BeginWithUnfilteredSvAndEndWithFilteredSv) {
  const auto ping = by_hand();
  const NoiseSteps steps(ping);
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    EXPECT_EQ(steps.value(NoiseStep::unfiltered, i), ping->sv.counts.all()[i]);
    EXPECT_EQ(steps.counts(NoiseStep::background).all()[i], ping->filtered->counts.all()[i]);
    const bool water = !any(ping->filtered->flags.all()[i] & kNeverMember);
    EXPECT_EQ(steps.value(NoiseStep::seabed, i), water ? ping->filtered->counts.all()[i] : kNoData) << i;
  }
}

TEST(NoiseSteps, TakeOutASampleAtTheFirstThatGivesAReason) {
  const NoiseSteps steps(by_hand());
  const auto there_behind = [&](NoiseStep step, int sample) { return steps.value(step, at(0, sample)) != kNoData; };
  EXPECT_FALSE(there_behind(NoiseStep::near_field, 0));
  EXPECT_TRUE(there_behind(NoiseStep::corrupted_packets, 1));
  EXPECT_FALSE(there_behind(NoiseStep::interference, 1));
  EXPECT_TRUE(there_behind(NoiseStep::median, 1)) << "the median fills it in";
  EXPECT_TRUE(there_behind(NoiseStep::median, 2));
  EXPECT_FALSE(there_behind(NoiseStep::seabed, 2)) << "but not where there is no water";
  EXPECT_FALSE(there_behind(NoiseStep::unfiltered, 3)) << "never recorded";
  EXPECT_FALSE(there_behind(NoiseStep::near_field, 5));
}

TEST(NoiseSteps, TellWhatEachDid) {
  const NoiseSteps steps(by_hand());
  const auto taken_out = [&](NoiseStep step) { return steps.effect(step).taken_out; };
  EXPECT_EQ(steps.effect(NoiseStep::near_field).recorded, 15);
  EXPECT_EQ(taken_out(NoiseStep::near_field), 2);
  EXPECT_EQ(taken_out(NoiseStep::surface), 0);
  EXPECT_EQ(taken_out(NoiseStep::dropouts), 0) << "what was not recorded was not there before";
  EXPECT_EQ(taken_out(NoiseStep::interference), 1) << "the other was out already";
  EXPECT_EQ(taken_out(NoiseStep::impulse_noise), 1);
  EXPECT_EQ(taken_out(NoiseStep::seabed), 2);
  // Of the first beam nothing lies below its noise of -70 dB, of the second all do: -43 below -42 dB.
  EXPECT_EQ(taken_out(NoiseStep::background), 8);
  const NoiseEffect& interference = steps.effect(NoiseStep::interference);
  EXPECT_EQ(interference.replaced, 1);
  ASSERT_TRUE(interference.replaced_db);
  EXPECT_NEAR(*interference.replaced_db, -10.0, 0.02);
  EXPECT_FALSE(steps.effect(NoiseStep::impulse_noise).replaced_db) << "behind the seabed";
  EXPECT_FALSE(interference.change_db);
  EXPECT_EQ(steps.effect(NoiseStep::background).replaced, 0) << "nothing comes in the place of the last step's";
  EXPECT_FALSE(steps.effect(NoiseStep::seabed).replaced_db);
  // Filled in: samples 1, 2 and 3. Changed: 4, 6 and 7 by -10 dB, the second beam's eight by -3 dB.
  const NoiseEffect& median = steps.effect(NoiseStep::median);
  EXPECT_EQ(median.filled_in, 3);
  EXPECT_EQ(median.changed, 11);
  ASSERT_TRUE(median.change_db);
  EXPECT_NEAR(*median.change_db, -3.0, 0.02);
}

TEST(NoiseSteps, OfSomeSamplesAddUpToThoseOfThePing) {
  const NoiseSteps steps(by_hand());
  std::vector<std::int32_t> first(8);
  std::iota(first.begin(), first.end(), 0);
  std::vector<std::int32_t> second(8);
  std::iota(second.begin(), second.end(), 8);
  for (std::size_t i = 0; i < kNoiseStepNames.size(); ++i) {
    const auto step = static_cast<NoiseStep>(i);
    const NoiseEffect a = steps.effect(step, first);
    const NoiseEffect b = steps.effect(step, second);
    const NoiseEffect& both = steps.effect(step);
    EXPECT_EQ(a.recorded + b.recorded, both.recorded);
    EXPECT_EQ(a.taken_out + b.taken_out, both.taken_out);
    EXPECT_EQ(a.filled_in + b.filled_in, both.filled_in);
    EXPECT_EQ(a.changed + b.changed, both.changed);
    EXPECT_EQ(a.kept + b.kept, both.kept);
  }
}

// What a step leaves is what the next one finds: along the steps, samples come and go by what each of them tells.
TEST(NoiseSteps, Compose) {
  const NoiseSteps steps(by_hand());
  std::int64_t there = steps.effect(NoiseStep::unfiltered).recorded;
  for (std::size_t i = 0; i < kNoiseStepNames.size(); ++i) {
    const auto step = static_cast<NoiseStep>(i);
    there += steps.effect(step).filled_in - steps.effect(step).taken_out;
    std::int64_t counted = 0;
    for (std::size_t voxel = 0; voxel < kShape.size(); ++voxel) counted += steps.value(step, voxel) != kNoData ? 1 : 0;
    EXPECT_EQ(there, counted) << kNoiseStepNames[i];
  }
}

TEST(NoiseSteps, AreSwitchedByTheRecipeEachByItsOwnSwitch) {
  const auto off = [](NoiseStep step) {
    Recipe recipe;
    switch (step) {
      case NoiseStep::near_field:
        recipe.flags.near_field.enabled = false;
        break;
      case NoiseStep::surface:
        recipe.flags.surface.enabled = false;
        break;
      case NoiseStep::dropouts:
        recipe.flags.dropouts.enabled = false;
        break;
      case NoiseStep::corrupted_packets:
        recipe.flags.corrupted_packets.enabled = false;
        break;
      case NoiseStep::interference:
        recipe.flags.interference.enabled = false;
        break;
      case NoiseStep::impulse_noise:
        recipe.flags.impulse_noise.enabled = false;
        break;
      case NoiseStep::median:
        recipe.median.enabled = false;
        break;
      case NoiseStep::seabed:
        recipe.seabed.enabled = false;
        break;
      case NoiseStep::background:
        recipe.background_window.enabled = false;
        break;
      case NoiseStep::unfiltered:
        break;
    }
    return recipe;
  };
  for (std::size_t i = 1; i < kNoiseStepNames.size(); ++i) {
    const Recipe recipe = off(static_cast<NoiseStep>(i));
    for (std::size_t k = 0; k < kNoiseStepNames.size(); ++k) {
      EXPECT_EQ(is_on(static_cast<NoiseStep>(k), recipe), k != i) << kNoiseStepNames[i] << " " << kNoiseStepNames[k];
    }
  }
}

}  // namespace
}  // namespace sonar
