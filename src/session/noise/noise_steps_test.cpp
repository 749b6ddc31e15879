// SPDX-License-Identifier: Apache-2.0
// Noise steps of simulated pings with every noise in them: what the pipeline does when it is stopped behind each step.
#include "pipeline/stages/noise_steps.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "session/test_survey.h"

namespace sonar {
namespace {

/// Four pings with ringing, interference, impulse noise, corrupted packets and dropouts, each often enough to be in them.
class NoisySurvey {
 public:
  NoisySurvey() : root_(TestSurvey::easy().fresh()) {
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 1;
    params.pings = 4;
    params.schools = 1;
    params.noise.corrupted_packets = 4.0;
    params.noise.interference = 4.0;
    params.noise.impulse_noise = 40.0;
    params.noise.dropouts = 2.0;
    Work work;
    const auto made = synth::simulate_survey(root_ / "raw", params, synth::ms70_beams(), false, "test", work);
    SONAR_CHECK(made.has_value());
    const std::vector<std::filesystem::path> paths{root_ / "raw"};
    auto opened = open_survey(paths, {}, {}, {}, work);
    SONAR_CHECK(opened.has_value());
    survey = std::move(*opened);
  }
  [[nodiscard]] std::shared_ptr<const StagedPing> staged(const Recipe& recipe, std::int64_t ping) const {
    Engine engine(survey, survey.observations.at(0), recipe);
    Work work;
    EXPECT_TRUE(engine.estimate_background(ping, ping, work));
    auto made = engine.staged(ping);
    SONAR_CHECK(made.has_value());
    return std::make_shared<const StagedPing>(std::move(*made));
  }

  SurveyFiles survey;

 private:
  std::filesystem::path root_;
};

const NoisySurvey& noisy() {
  static const NoisySurvey survey;
  return survey;
}

/// The recipe, stopped behind a step: whatever comes later is off.
Recipe stopped_behind(NoiseStep last) {
  Recipe recipe;
  const auto off_after = [&](NoiseStep step, bool& enabled) {
    if (step > last) enabled = false;
  };
  off_after(NoiseStep::near_field, recipe.flags.near_field.enabled);
  off_after(NoiseStep::surface, recipe.flags.surface.enabled);
  off_after(NoiseStep::dropouts, recipe.flags.dropouts.enabled);
  off_after(NoiseStep::corrupted_packets, recipe.flags.corrupted_packets.enabled);
  off_after(NoiseStep::interference, recipe.flags.interference.enabled);
  off_after(NoiseStep::impulse_noise, recipe.flags.impulse_noise.enabled);
  off_after(NoiseStep::median, recipe.median.enabled);
  off_after(NoiseStep::seabed, recipe.seabed.enabled);
  return recipe;
}

// A run of the very pipeline that ends behind a step gives, of every sample, what the steps of a whole run tell of it there.
// What no recipe leaves in (not recorded, above the water) is out from the beginning.
TEST(NoiseStepsOfAPing, AreThoseOfAPipelineThatStopsBehindEach) {
  constexpr std::int64_t kPing = 1;
  const NoiseSteps steps(noisy().staged(Recipe{}, kPing));
  const auto never = noisy().staged(stopped_behind(NoiseStep::unfiltered), kPing);
  const std::span<const SampleFlags> always = never->sv.flags.all();
  for (int i = 0; i < static_cast<int>(NoiseStep::median); ++i) {
    const auto step = static_cast<NoiseStep>(i);
    const auto stopped = noisy().staged(stopped_behind(step), kPing);
    ASSERT_EQ(stopped->sv.counts, steps.ping().sv.counts) << "unfiltered Sv is what it is";
    std::int64_t differing = 0;
    for (std::size_t voxel = 0; voxel < always.size(); ++voxel) {
      if (any(always[voxel])) continue;
      const std::int16_t expected =
          any(stopped->sv.flags.all()[voxel] & kNotFiltered) ? kNoData : stopped->sv.counts.all()[voxel];
      differing += steps.value(step, voxel) != expected ? 1 : 0;
    }
    EXPECT_EQ(differing, 0) << kNoiseStepNames[static_cast<std::size_t>(i)];
  }
  const auto filtered = noisy().staged(stopped_behind(NoiseStep::median), kPing);
  std::int64_t differing = 0;
  for (std::size_t voxel = 0; voxel < always.size(); ++voxel) {
    differing += steps.value(NoiseStep::median, voxel) != filtered->filtered->counts.all()[voxel] ? 1 : 0;
  }
  EXPECT_EQ(differing, 0) << "behind the median all is filtered Sv, and nothing else";
}

TEST(NoiseStepsOfAPing, BeginWithUnfilteredAndEndWithFilteredSvBitForBit) {
  for (std::int64_t ping = 0; ping < 4; ++ping) {
    const auto staged = noisy().staged(Recipe{}, ping);
    const NoiseSteps steps(staged);
    const auto same = [](View3<const std::int16_t> a, const Array3<std::int16_t>& b) {
      return std::equal(a.all().begin(), a.all().end(), b.all().begin(), b.all().end());
    };
    EXPECT_TRUE(same(steps.counts(NoiseStep::unfiltered), staged->sv.counts));
    EXPECT_TRUE(same(steps.counts(NoiseStep::background), staged->filtered->counts));
    EXPECT_EQ(NoiseSteps::out(NoiseStep::unfiltered), SampleFlags::none);
    for (std::size_t voxel = 0; voxel < staged->sv.counts.all().size(); ++voxel) {
      const SampleFlags told = steps.flags().all()[voxel];
      ASSERT_EQ(told & kNotFiltered, staged->filtered->flags.all()[voxel] & kNotFiltered);
    }
  }
}

// The tests above would say nothing of a step that found nothing. What the simulator drops are channels that never arrived:
// of these nothing is there to be taken out.
TEST(NoiseStepsOfAPing, AllDoSomethingToNoisyPings) {
  for (std::size_t i = 1; i < kNoiseStepNames.size(); ++i) {
    if (static_cast<NoiseStep>(i) == NoiseStep::dropouts) continue;
    std::int64_t touched = 0;
    for (std::int64_t ping = 0; ping < 4; ++ping) {
      const NoiseSteps steps(noisy().staged(Recipe{}, ping));
      const NoiseEffect& effect = steps.effect(static_cast<NoiseStep>(i));
      touched += effect.taken_out + effect.filled_in + effect.changed;
    }
    EXPECT_GT(touched, 0) << kNoiseStepNames[i];
  }
}

}  // namespace
}  // namespace sonar
