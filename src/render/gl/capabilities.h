// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"
#include "render/gl/gl_version.h"
#include "render/gl/upload.h"

namespace sonar {

/// What the current context can do, and what is best on it; the picture is the same whatever is chosen.
struct GlCapabilities {
  GlVersion version;
  std::string driver;
  int most_3d = 0;  ///< largest size of a 3-D texture
  int most_2d = 0;
  /// 16 bits on graphics processors; floats in software, where converting costs more than reading (llvmpipe: 8 %)
  Voxels sv_voxels = Voxels::snorm16;
};

/// errors  unsupported: no context is current, or one below OpenGL 4.1
[[nodiscard]] Result<GlCapabilities> capabilities();

}  // namespace sonar
