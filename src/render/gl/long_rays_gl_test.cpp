// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/units.h"
#include "base/work.h"
#include "render/gl/context_egl.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_test_scene.h"

namespace sonar {
namespace {

// As the processor's LongRays: a multiple of the step tens of thousands of steps out, rounded, may be the place where the
// ray is already; one that stood still would be cut short, and be too clear. 30 000 samples: a software driver (llvmpipe) ends any
// loop after 65 535 turns, and a sample along the beams takes two.
TEST(LongRaysGl, ComeToTheirEnd) {
  auto context = ContextEgl::make();
  if (!context) GTEST_SKIP() << "no OpenGL here: " << context.error().text;
  ASSERT_TRUE(context->make_current());
  const auto renderer = make_gl_renderer({});
  ASSERT_TRUE(renderer);
  Work work(1);
  OpticalTable faint;
  faint.rgb_extinction = {{0.25F, 0.5F, 0.75F, 1e-4F}, {0.25F, 0.5F, 0.75F, 1e-4F}};
  for (const double spacing_m : {0.0173, 0.05, 1.0 / 30.0, 0.1}) {
    const gl_test::Grid grid{
        "", gl_test::evenly(-25.0, -20.0, 2), gl_test::evenly(0.0, 6.0, 2), {0.0, spacing_m, 30000}};
    const Shape3 shape{2, 2, grid.range.count};
    const auto counts = static_cast<std::int16_t>(std::lround(counts_from_db(-50.0)));
    const auto volume =
        std::make_shared<VolumeData>(VolumeData{gl_test::sector_of(grid), Array3<std::int16_t>(shape, counts), -1e9});
    VolumeView view;
    view.size = {1, 1};
    const Point<Sonar> out = Sector::direction(rad_from_deg(-22.0), rad_from_deg(3.0));
    view.camera.eye = out * -5.0;
    view.camera.target = out * 30.0;
    ASSERT_TRUE((*renderer)->set_volume(volume));
    ASSERT_TRUE((*renderer)->set_transfer(faint));
    const auto rays = (*renderer)->draw(view, {1, 1.0, 0.0, 0}, work);
    ASSERT_TRUE(rays) << to_line(rays.error());
    EXPECT_NEAR(rays->rgba[0][3], 1.0 - std::exp(-1e-4 * 29999 * spacing_m), 1e-3) << spacing_m;
  }
}

}  // namespace
}  // namespace sonar
