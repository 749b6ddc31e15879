// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>

#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/surface_laws.h"

namespace sonar {
namespace {

using namespace surface_laws;

class SurfacesGl : public testing::Test {
 protected:
  void SetUp() override {
    auto made = ContextEgl::make();
    if (!made) GTEST_SKIP() << "no OpenGL here: " << made.error().text;
    context_ = std::move(*made);
    ASSERT_TRUE(context_.make_current());
    auto renderer = make_gl_renderer();
    ASSERT_TRUE(renderer) << renderer.error().text;
    renderer_ = std::move(*renderer);
  }
  ContextEgl context_;
  std::unique_ptr<VolumeRenderer> renderer_;
};

TEST_F(SurfacesGl, ABallIsRound) { a_ball_is_round(*renderer_); }
TEST_F(SurfacesGl, NothingDarkensALoneBall) { nothing_darkens_a_lone_ball(*renderer_); }
TEST_F(SurfacesGl, ARoundRoomIsAsDarkAsItIsWide) { a_round_room_is_as_dark_as_it_is_wide(*renderer_); }
TEST_F(SurfacesGl, TwoBallsDarkenEachOther) { two_balls_darken_each_other(*renderer_); }
TEST_F(SurfacesGl, ASurfaceStandsInItsWater) { a_surface_stands_in_its_water(*renderer_); }
TEST_F(SurfacesGl, ItIsBothOfWhatItIsMadeOf) { it_is_both_of_what_it_is_made_of(*renderer_); }
TEST_F(SurfacesGl, WhatIsFarFades) { what_is_far_fades(*renderer_); }
TEST_F(SurfacesGl, AgreesWithTheReference) { agrees_with_the_reference(*renderer_); }
TEST_F(SurfacesGl, FramesAtRestSmoothEdges) { frames_at_rest_smooth_edges(*renderer_); }

/// Both back-ends look for the same light in the same frame.
TEST_F(SurfacesGl, AgreesWithTheProcessorFrameByFrame) {
  const auto cpu = make_cpu_renderer();
  VolumeView seen = view(45.0, RayMode::volume_and_surface);
  seen.lighting = sky_alone(10.0F);
  const std::vector<Ball> two{lone_ball(), {centre() + Point<Sonar>{7.0, 7.0, 0.0}, 4.0, 2.0}};
  for (const std::uint32_t frame : {0U, 3U}) {
    const DrawQuality quality{1, 1.0, 0.03, frame};
    const Image ours = over(drawn(*renderer_, balls(two), table(0.01F, 0.01F), seen, quality), Rgba8{0, 0, 0, 255});
    EXPECT_GT(psnr_db(over(drawn(*cpu, balls(two), table(0.01F, 0.01F), seen, quality), Rgba8{0, 0, 0, 255}), ours),
              45.0)
        << frame;
  }
}

}  // namespace
}  // namespace sonar
