// SPDX-License-Identifier: Apache-2.0
#include "render/gl/gl_state.h"

#include <epoxy/gl.h>

#include <initializer_list>

namespace sonar {
namespace {

void plain_tests() {
  for (const GLenum off : std::initializer_list<GLenum>{
           GL_BLEND, GL_COLOR_LOGIC_OP, GL_CULL_FACE, GL_DEPTH_TEST, GL_DITHER, GL_FRAMEBUFFER_SRGB,
           GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH, GL_PRIMITIVE_RESTART, GL_RASTERIZER_DISCARD,
           GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK, GL_SCISSOR_TEST,
           GL_STENCIL_TEST}) {
    glDisable(off);
  }
  for (GLenum i = 0; i < 8; ++i) {
    glDisable(GL_CLIP_DISTANCE0 + i);
  }
  glEnable(GL_DEPTH_CLAMP);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glStencilMask(0xFFU);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthRangef(0.0F, 1.0F);
  if (epoxy_gl_version() >= 45) {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  }
}

}  // namespace

void plain_copies() {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (const GLenum zero : std::initializer_list<GLenum>{
           GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
           GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH,
           GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES}) {
    glPixelStorei(zero, 0);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

PlainState::PlainState(PixelSize viewport, int texture_units) {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  plain_tests();
  plain_copies();
  for (int i = 0; i < texture_units; ++i) {
    glBindSampler(static_cast<GLuint>(i), 0);
  }
  glViewport(0, 0, viewport.width, viewport.height);
}

PlainState::~PlainState() {
  glBindVertexArray(0);
  glUseProgram(0);
  glActiveTexture(GL_TEXTURE0);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_DEPTH_CLAMP);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
}

const char* gl_complaint() {
  const char* out = "";
  for (int i = 0; i < 32; ++i) {
    switch (glGetError()) {
      case GL_NO_ERROR:
        return out;
      case GL_OUT_OF_MEMORY:
        out = "out of memory";
        break;
      case GL_INVALID_FRAMEBUFFER_OPERATION:
        out = "incomplete framebuffer";
        break;
      default:
        out = "invalid operation";
        break;
    }
  }
  return "no end of errors";
}

}  // namespace sonar
