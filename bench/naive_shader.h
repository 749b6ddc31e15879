// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/volume_renderer.h"

namespace sonar::bench {

/// What the paper's way gives, and at what cost.
struct NaiveFrame {
  RayImage picture;     ///< alpha 1 where the sector was met
  double wall_s = 0.0;  ///< a frame, minimum of all
  double cpu_s = 0.0;   ///< a frame, all threads, mean of all
};

/// The ray-caster of the 2007 paper, the rival to be measured against: the sector's tessellated surface gives start and
/// end of the rays, each sample is turned to spherical coordinates by atan and acos, one constant step, nothing but
/// early termination is skipped. Volume as one R32F texture, evenly spaced beams assumed, accumulate only, black behind.
/// Needs a current OpenGL context of version 4.1 or higher; `frames` are timed after one that is not.
/// returns  wall seconds of a frame (as in `out`); NaN where the shader or a texture does not work here
double naive_frame(const VolumeData& volume, const OpticalTable& table, const VolumeView& view, double step_m,
                   int frames, NaiveFrame& out);

}  // namespace sonar::bench
