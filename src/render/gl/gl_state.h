// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/image.h"

namespace sonar {

/// Puts every state that a pass here relies on to its plain value, whatever the context was left in: no blending,
/// tests, clipping or discarding, all channels written, filled polygons, texture units without sampler objects, pixels
/// copied tightly from and to memory. The binding of framebuffers is put back at the end of its life.
class PlainState {
 public:
  PlainState(PixelSize viewport, int texture_units);
  ~PlainState();
  PlainState(const PlainState&) = delete;
  PlainState& operator=(const PlainState&) = delete;

 private:
  int draw_framebuffer_ = 0;
  int read_framebuffer_ = 0;
};

/// Pixels and texels are copied tightly, from and to memory (not a buffer).
void plain_copies();

/// A word for what went wrong since last asked; empty where nothing did.
[[nodiscard]] const char* gl_complaint();

}  // namespace sonar
