// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/noise_steps.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "signal/flag_steps.h"

namespace sonar {
namespace {

struct StepFacts {
  std::string_view words;
  SampleFlags reason = SampleFlags::none;
};

constexpr std::array<StepFacts, kNoiseStepNames.size()> kSteps{{{"Unfiltered Sv"},
                                                                {"Near field", SampleFlags::near_field},
                                                                {"Sea surface", SampleFlags::surface},
                                                                {"Dropouts", SampleFlags::dropout},
                                                                {"Corrupted packets", SampleFlags::corrupted},
                                                                {"Interference", SampleFlags::interference},
                                                                {"Impulse noise", SampleFlags::impulse},
                                                                {"Median filter"},
                                                                {"Seabed", SampleFlags::seabed},
                                                                {"Background noise", SampleFlags::low_snr}}};

constexpr bool flags_come_in_their_order() {
  for (std::size_t i = 0; i < kFlagSteps.size(); ++i) {
    if (kSteps[i + 1].reason != kFlagSteps[i]) return false;
  }
  return true;
}
static_assert(flags_come_in_their_order(), "as flag_ping() takes them");

const StepFacts& facts_of(NoiseStep step) { return kSteps[static_cast<std::size_t>(step)]; }

std::optional<double> middle_db(std::vector<int>& counts) {
  if (counts.empty()) return std::nullopt;
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  if (counts.size() % 2 == 1) return db_from_counts(*middle);
  return db_from_counts(0.5 * (*middle + *std::max_element(counts.begin(), middle)));
}

/// Adds one sample after the other.
class Counting {
 public:
  void add(std::int16_t recorded, std::int16_t before, std::int16_t behind, std::int16_t filtered) {
    if (recorded != kNoData) ++effect_.recorded;
    if (before != kNoData && behind == kNoData) {
      ++effect_.taken_out;
      if (filtered != kNoData && recorded != kNoData) replaced_.push_back(filtered - recorded);
    } else if (before == kNoData && behind != kNoData) {
      ++effect_.filled_in;
    } else if (before != kNoData) {
      // Steps that take samples out leave the others as they are.
      ++(before == behind ? effect_.kept : effect_.changed);
      if (before != behind) changes_.push_back(behind - before);
    }
  }
  [[nodiscard]] NoiseEffect done() {
    changes_.resize(changes_.size() + static_cast<std::size_t>(effect_.changed > 0 ? effect_.kept : 0));
    effect_.change_db = middle_db(changes_);
    effect_.replaced = static_cast<std::int64_t>(replaced_.size());
    effect_.replaced_db = middle_db(replaced_);
    return effect_;
  }

 private:
  NoiseEffect effect_;
  std::vector<int> changes_;   ///< counts, without those that are none
  std::vector<int> replaced_;  ///< counts
};

}  // namespace

std::string_view noise_step_words(NoiseStep step) { return facts_of(step).words; }

bool is_on(NoiseStep step, const Recipe& recipe) {
  switch (step) {
    case NoiseStep::unfiltered:
      return true;
    case NoiseStep::near_field:
      return recipe.flags.near_field.enabled;
    case NoiseStep::surface:
      return recipe.flags.surface.enabled;
    case NoiseStep::dropouts:
      return recipe.flags.dropouts.enabled;
    case NoiseStep::corrupted_packets:
      return recipe.flags.corrupted_packets.enabled;
    case NoiseStep::interference:
      return recipe.flags.interference.enabled;
    case NoiseStep::impulse_noise:
      return recipe.flags.impulse_noise.enabled;
    case NoiseStep::median:
      return recipe.median.enabled;
    case NoiseStep::seabed:
      return recipe.seabed.enabled;
    case NoiseStep::background:
      return recipe.background_window.enabled;
  }
  return false;
}

View3<const std::int16_t> NoiseSteps::counts(NoiseStep step) const {
  return step < NoiseStep::median ? ping_->sv.counts.view() : std::as_const(ping_->filtered->counts).view();
}

SampleFlags NoiseSteps::out(NoiseStep step) {
  SampleFlags out = SampleFlags::none;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(step); ++i) out |= kSteps[i].reason;
  return step < NoiseStep::median ? out : out & (kNeverMember | SampleFlags::low_snr);
}

std::int16_t NoiseSteps::value(NoiseStep step, std::size_t voxel) const {
  return any(flags_.all()[voxel] & out(step)) ? kNoData : counts(step).all()[voxel];
}

namespace {

/// Sv of a ping behind one of its steps.
struct Behind {
  Behind(const NoiseSteps& steps, NoiseStep step)
      : counts(steps.counts(step).all()), flags(steps.flags().all()), out(NoiseSteps::out(step)) {}
  [[nodiscard]] std::int16_t operator()(std::size_t voxel) const {
    return any(flags[voxel] & out) ? kNoData : counts[voxel];
  }
  std::span<const std::int16_t> counts;
  std::span<const SampleFlags> flags;
  SampleFlags out;
};

/// The samples, named one by one or all.
template <class Each>
NoiseEffect counted(const NoiseSteps& steps, NoiseStep step, std::size_t samples, const Each& voxel) {
  const auto recorded = steps.ping().sv.counts.all();
  const Behind on_this_side(steps, before(step));
  const Behind beyond(steps, step);
  const Behind filtered(steps, NoiseStep::seabed);
  Counting counting;
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t at = voxel(i);
    // Behind the median filter nothing comes in the place of what is taken out.
    counting.add(recorded[at], on_this_side(at), beyond(at), step < NoiseStep::median ? filtered(at) : kNoData);
  }
  return counting.done();
}

}  // namespace

NoiseSteps::NoiseSteps(std::shared_ptr<const StagedPing> ping)
    : ping_(std::move(ping)), flags_(ping_->filtered->flags.shape()) {
  flag_weak(*ping_, 0.0, flags_.view());
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    effects_[i] =
        counted(*this, static_cast<NoiseStep>(i), flags_.all().size(), [](std::size_t voxel) { return voxel; });
  }
}

NoiseEffect NoiseSteps::effect(NoiseStep step, std::span<const std::int32_t> voxels) const {
  return counted(*this, step, voxels.size(), [&](std::size_t i) { return static_cast<std::size_t>(voxels[i]); });
}

}  // namespace sonar
