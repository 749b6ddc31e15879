// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "synth/presets.h"

namespace sonar::synth {

/// A scene with the survey's water, noise and ship, without course, schools or start of its own.
[[nodiscard]] Scene scene_base(const SurveyParams& params, const std::vector<Beam>& beams, int observation);

/// Two opposing transects past the same schools with an empty leg between them. School 1 is passed at 100 m, then at
/// 300 m; school 2 swims out through the aft side; on school 3 lie a beam with corrupted packets and interference.
[[nodiscard]] std::vector<Scene> demo_scenes(const SurveyParams& params, const std::vector<Beam>& beams);

}  // namespace sonar::synth
