// SPDX-License-Identifier: Apache-2.0
#include "render/gl/capabilities.h"

#include <epoxy/gl.h>

namespace sonar {

Result<GlCapabilities> capabilities() {
  GlCapabilities out;
  out.version = current_version();
  out.driver = current_driver();
  if (auto ok = check_version(out.version, out.driver); !ok) {
    return pass_on(ok);
  }
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &out.most_3d);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &out.most_2d);
  if (draws_by_software(out.driver)) out.sv_voxels = Voxels::float32;
  return out;
}

}  // namespace sonar
