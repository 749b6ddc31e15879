// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render/volume_renderer.h"

namespace sonar {

/// What can be forced on the OpenGL back-end, for tests and for measuring; the picture stays the same.
struct GlRendererOptions {
  int most_3d = 0;             ///< largest size of a 3-D texture; 0 = the driver's. Larger volumes are folded.
  bool sv_in_16_bits = false;  ///< also on software drivers, where floats are faster
};

/// The paper's ray-caster on OpenGL 4.1 core: draws with the context that is current, which must be current again
/// whenever it is called or destroyed, and leaves the bindings of framebuffers as they were.
/// threads  those of the context
/// errors   unsupported: no context is current, it is below OpenGL 4.1, or its driver does not take the shaders
[[nodiscard]] Result<std::unique_ptr<VolumeRenderer>> make_gl_renderer(const GlRendererOptions& options = {});

}  // namespace sonar
