// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/noise_steps.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/slices/slice_steps.h"

namespace sonar {

/// What a step did to a ping and to a slice of it, in lines: "takes out 0.4 % of the ping, 1.2 % of the slice".
/// on  whether the recipe takes the step
[[nodiscard]] std::vector<std::string> noise_effect_words(NoiseStep step, bool on, const NoiseEffect& ping,
                                                          const NoiseEffect& slice);

/// All steps of a ping as a picture shows them; borrows from `steps`.
/// recipe  that the ping was processed with
/// cost    about 50 ms for 20 x 25 x 1320 samples
[[nodiscard]] SliceStepsData noise_steps_data(const NoiseSteps& steps, const Recipe& recipe, const Sector& sector,
                                              const Slice& slice);

/// The two steps that the parameters compare; empty = all are shown.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> compared_steps(const NoiseStepsParams& params);

[[nodiscard]] SliceStepsStyle noise_steps_style(const NoiseStepsParams& params, const DisplayParams& display,
                                                SvColours colours);

/// A slice at each noise step, of the ping that the options choose.
/// errors  not_found: no raw files; as slice_frame()
[[nodiscard]] Result<FrameDescription> noise_steps_frame(DrawnObservation& observation, const PictureOptions& options,
                                                         Work& work);

}  // namespace sonar
