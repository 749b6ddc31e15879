// SPDX-License-Identifier: Apache-2.0
// The variants of the ray's shader that tests go through.
#pragma once

#include <vector>

#include "render/gl/volume_pass.h"

namespace sonar::gl_test {

/// All that a picture may ask for in all modes, then all shapes of a sector.
[[nodiscard]] inline std::vector<RayVariant> every_variant() {
  std::vector<RayVariant> out;
  for (const RayMode mode : {RayMode::accumulate, RayMode::first_hit, RayMode::maximum, RayMode::volume_and_surface}) {
    for (int bits = 0; bits < 32; ++bits) {
      RayVariant v{.mode = mode};
      v.lit = (bits & 1) != 0;
      v.data = (bits & 2) != 0;
      v.gapped = (bits & 4) != 0;
      v.folded = (bits & 8) != 0;
      v.mask_words = (bits & 16) != 0 ? 8 : 0;
      v.opaque = v.lit;
      v.cued = v.folded;
      out.push_back(v);
    }
  }
  for (int bits = 0; bits < 64; ++bits) {
    RayVariant v;
    v.inner = (bits & 1) != 0;
    v.wide = (bits & 2) != 0;
    v.low_hole = (bits & 4) != 0;
    v.high_hole = (bits & 8) != 0;
    v.even_beams = (bits & 16) != 0;
    v.even_fans = (bits & 32) != 0;
    out.push_back(v);
  }
  return out;
}

}  // namespace sonar::gl_test
