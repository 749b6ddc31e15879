// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "base/work.h"
#include "render/test_scenes.h"
#include "render/volume_renderer.h"

namespace sonar {
namespace {

using namespace scenes;

// A multiple of the step tens of thousands of steps out, rounded, may be the place where the ray is already.
TEST(LongRays, ComeToAnEndAfterTensOfThousandsOfSteps) {
  OpticalTable faint;
  faint.rgb_extinction = {{0.25F, 0.5F, 0.75F, 1e-4F}, {0.25F, 0.5F, 0.75F, 1e-4F}};
  for (const double spacing_m : {0.0173, 0.05, 1.0 / 30.0, 0.1}) {
    const Sector s{even(-25.0, -20.0, 2), even(0.0, 6.0, 2), RangeAxis{0.0, spacing_m, 40000}};
    auto data = volume(s, 0.0);
    for (auto& sv : data->sv.all()) sv = static_cast<std::int16_t>(std::lround(counts_from_db(-50.0)));
    VolumeView view;
    view.size = {1, 1};
    const auto out = Sector::direction(rad_from_deg(-22.0), rad_from_deg(3.0));
    view.camera = looking(out * -5.0, out * 30.0);
    const double length_m = 39999 * spacing_m;
    const auto renderer = make_cpu_renderer();
    ASSERT_TRUE(renderer->set_volume(data));
    ASSERT_TRUE(renderer->set_transfer(faint));
    Work work(1);
    const auto rays = renderer->draw(view, {1, 1.0, 0.0, 0}, work);
    ASSERT_TRUE(rays);
    EXPECT_NEAR(rays->rgba[0][3], 1.0 - std::exp(-1e-4 * length_m), 1e-3) << spacing_m;
  }
}

}  // namespace
}  // namespace sonar
