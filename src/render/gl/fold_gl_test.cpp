// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "render/gl/fold_plan.h"
#include "render/gl/gl_version.h"
#include "render/gl/test_volume_gl.h"

namespace sonar {
namespace {

using gl_test::Grid;
using gl_test::grid_named;
using gl_test::largest_step;
using gl_test::on_black;
using gl_test::two_masks;
using gl_test::VolumeGl;
using gl_test::with_gaps;

/// Along the range, where each piece begins with the last sample of the one before; and how they lie in the texture.
void expect_folds(const Shape3& shape, int limit) {
  const auto plan = plan_folds(shape, limit);
  ASSERT_TRUE(plan);
  const int pieces = (shape.samples - 1 + limit - 2) / (limit - 1);
  EXPECT_GT(pieces, 1) << "nothing is folded";
  EXPECT_EQ(plan->pieces[0], pieces) << shape.samples << " samples, limit " << limit;
  EXPECT_EQ(plan->channels, std::min(pieces * plan->pieces[1] * plan->pieces[2], 4));
  EXPECT_TRUE(plan->folded());
}

TEST_F(VolumeGl, FoldedAndUnfoldedPicturesAreEqual) {
  // Not bit by bit: the same place has other coordinates in another texture, rounded at about 1e-5 of a sample. Graphics
  // cards interpolate with 8 bits of a fraction, where software takes all: 3.5 steps of 255 were seen on one.
  const double most = draws_by_software(current_driver()) ? 1.0 : 5.0;
  const std::vector<std::pair<Shape3, std::vector<int>>> foldings{{{10, 13, 150}, {128, 64, 33}},
                                                                  {{20, 25, 1319}, {512, 300, 128}},
                                                                  {{40, 60, 1319}, {512, 300, 256}},
                                                                  {{6, 7, 10000}, {2048, 512}}};
  for (const auto& [shape, limits] : foldings) {
    const Grid grid{"",
                    gl_test::evenly(-45.0, 0.0, shape.fans),
                    gl_test::evenly(60.0, 120.0, shape.beams),
                    {0.0, 500.0 / shape.samples, shape.samples}};
    const auto volume = with_gaps(grid);
    const auto masks = two_masks(shape);
    VolumeView view = gl_test::view_of(volume->sector);
    const DrawQuality quality{.step_samples = std::max(1.0, shape.samples / 1319.0)};
    const RayImage whole = drawn(volume, gl_test::table_of(true), view, quality, masks);
    for (const int limit : limits) {
      expect_folds(shape, limit);
      const auto gl = renderer({.most_3d = limit});
      ASSERT_TRUE(gl->set_volume(volume)) << limit;
      ASSERT_TRUE(gl->set_transfer(gl_test::table_of(true)));
      ASSERT_TRUE(gl->set_masks(masks));
      const RayImage folded = drawn(*gl, view, quality);
      EXPECT_LT(largest_step(whole, folded), most) << shape.samples << " samples, limit " << limit;
    }
  }
}

TEST_F(VolumeGl, TenThousandSamplesAreFolded) {
  const Grid grid{"", gl_test::evenly(-45.0, 0.0, 6), gl_test::evenly(60.0, 120.0, 7), {0.0, 0.05, 10000}};
  const auto volume = gl_test::volume_of(grid);
  const VolumeView view = gl_test::view_of(volume->sector);
  const RayImage truth = brute_force(*volume, gl_test::table_of(false), {}, view, 0.25, work_);
  // 2048 + 4 * 2047 >= 10000 > 2048 + 3 * 2047: five pieces, four channels and a second slot, as OpenGL 4.1 grants.
  expect_folds(volume->sv.shape(), 2048);
  EXPECT_EQ(plan_folds(volume->sv.shape(), 2048)->pieces[0], 5);
  EXPECT_EQ(plan_folds(volume->sv.shape(), 2048)->slots, (std::array{2, 1}));
  for (const int limit : {0, 2048}) {
    const RayImage there = drawn(volume, gl_test::table_of(false), view, {.step_samples = 4.0}, {}, {.most_3d = limit});
    EXPECT_GE(psnr_db(on_black(truth), on_black(there)), 40.0) << limit;
  }
}

TEST_F(VolumeGl, SixteenBitsLoseNothingVisible) {
  const auto volume = with_gaps(grid_named("even"));
  const VolumeView view = gl_test::view_of(volume->sector);
  for (const int limit : {0, 64}) {
    const RayImage floats = drawn(volume, gl_test::table_of(true), view, {}, {}, {.most_3d = limit});
    const RayImage shorts =
        drawn(volume, gl_test::table_of(true), view, {}, {}, {.most_3d = limit, .sv_in_16_bits = true});
    EXPECT_LT(largest_step(floats, shorts), 1.0);
  }
}

}  // namespace
}  // namespace sonar
