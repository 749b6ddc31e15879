// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/array.h"
#include "base/sample_flags.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/noise_step.h"

namespace sonar {

/// "Corrupted packets".
[[nodiscard]] std::string_view noise_step_words(NoiseStep step);
/// Whether the recipe takes the step; unfiltered Sv is always there.
[[nodiscard]] bool is_on(NoiseStep step, const Recipe& recipe);

/// What a step did to some of a ping's samples. A sample is there where it has a value and no step took it out.
struct NoiseEffect {
  std::int64_t recorded = 0;   ///< samples with data in unfiltered Sv
  std::int64_t taken_out = 0;  ///< there before the step, not behind it
  std::int64_t filled_in = 0;  ///< not there before the step, but behind it
  std::int64_t changed = 0;    ///< there on both sides, with another value
  std::int64_t kept = 0;       ///< there on both sides, with the same value
  /// Median of what the step adds to the samples that are there on both sides, dB; empty where it changes none.
  std::optional<double> change_db;
  /// Of the samples that it took out, those that the median filter gives a value, and the median of filtered minus
  /// unfiltered Sv of these, dB.
  std::int64_t replaced = 0;
  std::optional<double> replaced_db;
};

/// A ping before and behind each of its noise steps. Nothing is worked out anew: Sv is the ping's own, unfiltered or
/// filtered, and its flags tell which step took a sample out. What the background takes out are samples of filtered Sv below
/// the expected background; they keep their value, for the background is subtracted only where schools are measured.
/// threads  any
class NoiseSteps {
 public:
  /// cost  some passes over the ping, about 50 ms for 20 x 25 x 1320 samples
  explicit NoiseSteps(std::shared_ptr<const StagedPing> ping);

  [[nodiscard]] const StagedPing& ping() const { return *ping_; }
  /// [fan][beam][sample], Sv counts behind a step, those that were taken out included; borrowed.
  [[nodiscard]] View3<const std::int16_t> counts(NoiseStep step) const;
  /// [fan][beam][sample]: the flags of the ping, with low_snr where filtered Sv lies below the background; borrowed.
  [[nodiscard]] View3<const SampleFlags> flags() const { return flags_.view(); }
  /// Which of the flags keep a sample from being there behind a step. The median fills in what was faulty.
  [[nodiscard]] static SampleFlags out(NoiseStep step);

  /// Behind a step, Sv counts; kNoData = not there.
  /// voxel  (fan * beams + beam) * samples + sample
  [[nodiscard]] std::int16_t value(NoiseStep step, std::size_t voxel) const;
  /// What a step did to the whole ping, known from the beginning, and to some samples.
  /// cost  one pass over the samples
  [[nodiscard]] const NoiseEffect& effect(NoiseStep step) const { return effects_[static_cast<std::size_t>(step)]; }
  [[nodiscard]] NoiseEffect effect(NoiseStep step, std::span<const std::int32_t> voxels) const;

 private:
  std::shared_ptr<const StagedPing> ping_;
  Array3<SampleFlags> flags_;
  std::array<NoiseEffect, kNoiseStepNames.size()> effects_;  ///< on all samples
};

/// The step before; of unfiltered Sv that itself.
[[nodiscard]] constexpr NoiseStep before(NoiseStep step) {
  return step == NoiseStep::unfiltered ? step : static_cast<NoiseStep>(static_cast<int>(step) - 1);
}

}  // namespace sonar
