// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "synth/layout.h"
#include "synth/scene.h"

namespace sonar::synth {

// The things that go wrong in a ping, drawn by the scene's rates or placed on purpose.

/// Adds the power of corrupted packets, interference and impulse noise to the expected power.
void add_faults(const Layout& layout, const Scene& scene, int ping, View3<float> power_w);

/// [row]: whether the channel arrived.
[[nodiscard]] std::vector<bool> recorded_rows(const Layout& layout, const Scene& scene, int ping);

}  // namespace sonar::synth
