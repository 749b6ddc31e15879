// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/array.h"
#include "synth/layout.h"
#include "synth/scene.h"
#include "synth/truth.h"

namespace sonar::synth {

/// Everything of a scene that is the same in every ping.
struct Background {
  Array3<float> power_per_sv;     ///< W m: received power = this x sv (the sonar equation, absorption included)
  Array3<float> power_w;          ///< expected: noise, ringing, reverberation, surface
  std::vector<RowLimits> limits;  ///< [row]; without the seabed
};
[[nodiscard]] Background make_background(const Layout& layout, const Scene& scene);

}  // namespace sonar::synth
