// SPDX-License-Identifier: Apache-2.0
#include "render/gl/context_egl.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>

#include "render/gl/capabilities.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_state.h"
#include "render/gl/gl_test_scene.h"
#include "render/gl/shader_source.h"
#include "render/gl/volume_pass.h"

namespace sonar {

void gl_test::spoil_state() {
  for (const GLenum on :
       std::initializer_list<GLenum>{GL_BLEND, GL_COLOR_LOGIC_OP, GL_CULL_FACE, GL_DEPTH_TEST, GL_RASTERIZER_DISCARD,
                                     GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_CLIP_DISTANCE1, GL_PRIMITIVE_RESTART,
                                     GL_SAMPLE_ALPHA_TO_COVERAGE, GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL}) {
    glEnable(on);
  }
  glBlendFunc(GL_ZERO, GL_ZERO);
  glCullFace(GL_FRONT_AND_BACK);
  glDepthFunc(GL_NEVER);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glStencilMask(0);
  glStencilFunc(GL_NEVER, 3, 7);
  glScissor(1, 1, 2, 2);
  glViewport(3, 3, 5, 5);
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glPrimitiveRestartIndex(1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  glPixelStorei(GL_PACK_ROW_LENGTH, 9);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
  static GLuint sampler = 0;
  static GLuint buffer = 0;
  glGenSamplers(1, &sampler);
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  for (GLuint unit = 0; unit < kUnits; ++unit) glBindSampler(unit, sampler);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  glActiveTexture(GL_TEXTURE5);
  glUseProgram(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

namespace {

TEST(GlVersion, OnlyFourOneAndHigherWillDo) {
  EXPECT_TRUE(check_version({4, 1}, "some driver"));
  EXPECT_TRUE(check_version({5, 0}, "some driver"));
  const auto old = check_version({3, 3}, "Old Card");
  ASSERT_FALSE(old);
  EXPECT_EQ(old.error().code, ErrorCode::unsupported);
  EXPECT_EQ(old.error().text, "OpenGL 3.3 (Old Card) is too old; expected 4.1 or higher");
  EXPECT_FALSE(check_version({}, ""));
}

TEST(ContextEgl, WithoutAContextThereIsNoRenderer) {
  const auto made = make_gl_renderer();
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::unsupported);
  EXPECT_NE(made.error().text.find("no OpenGL context"), std::string::npos) << made.error().text;
}

class ContextGl : public testing::Test {
 protected:
  void SetUp() override {
    auto made = ContextEgl::make();
    if (!made) GTEST_SKIP() << "no OpenGL here: " << made.error().text;
    context_ = std::move(*made);
  }
  ContextEgl context_;
};

TEST_F(ContextGl, MovesAndEndsWithItsOwner) {
  ASSERT_TRUE(context_.make_current());
  EXPECT_GE(current_version(), kLeastGl);
  ContextEgl other = std::move(context_);
  EXPECT_TRUE(other);
  EXPECT_FALSE(context_);  // NOLINT(bugprone-use-after-move): what a moved one is, is what is asked
  EXPECT_FALSE(context_.make_current());
  EXPECT_GE(current_version(), kLeastGl) << "moving does not change what is current";
  other = ContextEgl();
  EXPECT_EQ(current_version(), GlVersion{});
}

TEST_F(ContextGl, AnImpossibleVersionFallsBackToOneThatIs) {
  auto high = ContextEgl::make({4, 99});
  ASSERT_TRUE(high);
  ASSERT_TRUE(high->make_current());
  EXPECT_GE(current_version(), kLeastGl);
  EXPECT_FALSE(ContextEgl::make({3, 3})) << "below what the shaders are written for";
}

TEST_F(ContextGl, ObjectsMoveAndEmptyOnesAreHarmless) {
  ASSERT_TRUE(context_.make_current());
  Buffer empty;
  EXPECT_EQ(empty.id(), 0U);
  Buffer one = Buffer::make();
  const unsigned id = one.id();
  glBindBuffer(GL_ARRAY_BUFFER, id);
  one.label("one");
  empty = std::move(one);
  EXPECT_EQ(empty.id(), id);
  EXPECT_EQ(glIsBuffer(id), GL_TRUE);
  empty.reset();
  EXPECT_EQ(glIsBuffer(id), GL_FALSE);
  EXPECT_NE(Query::make().id(), 0U);
  EXPECT_STREQ(gl_complaint(), "");
}

TEST_F(ContextGl, AWrongShaderIsRefusedInTheDriversWords) {
  ASSERT_TRUE(context_.make_current());
  const auto made = make_program("broken", "#version 410 core\nvoid main() { nonsense; }", "");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().text.find("'broken'"), std::string::npos);
  EXPECT_NE(made.error().text.find("nonsense"), std::string::npos) << made.error().text;
  EXPECT_EQ(made.error().text.find('\n'), std::string::npos);
}

TEST_F(ContextGl, EveryVariantOfTheShaderCompiles) {
  ASSERT_TRUE(context_.make_current());
  VolumePass pass;
  const auto good = [&](const RayVariant& variant) {
    const auto ok = pass.prepare(variant);
    EXPECT_TRUE(ok) << (ok ? "" : ok.error().text);
  };
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
      good(v);
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
    good(v);
  }
}

TEST(ShaderSource, FilesAreEmbedded) {
  EXPECT_NE(shader_source("volume.frag").find("void main()"), std::string_view::npos);
  EXPECT_TRUE(shader_source("no such file").empty());
}

}  // namespace
}  // namespace sonar
