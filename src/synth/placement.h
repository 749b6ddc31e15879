// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "synth/presets.h"
#include "synth/scene.h"

namespace sonar::synth {

/// Draws the schools of an observation into a scene whose ship, water, noise and beams are set: ids rise with the time
/// at which they are abeam; separate schools stay farther apart than their sizes while they are in view. Fewer than
/// asked for where there is no room.
void place_schools(const SurveyParams& params, Scene& scene);

/// Body with nuclei and vacuoles as the parameters say.
struct SizeAndLevel {
  double length_m;
  double width_m;
  double height_m;
  double axis_deg;
  double sv_db;
};
[[nodiscard]] BodyShape ragged_shape(const SurveyParams& params, const SizeAndLevel& size, std::uint64_t seed);

}  // namespace sonar::synth
