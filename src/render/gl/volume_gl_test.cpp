// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "render/gl/test_volume_gl.h"
#include "render/ray_rules.h"

namespace sonar {
namespace {

using gl_test::Grid;
using gl_test::grid_named;
using gl_test::largest_step;
using gl_test::on_black;
using gl_test::overlapping_masks;
using gl_test::two_masks;
using gl_test::VolumeGl;
using gl_test::with_gaps;

class VolumeGlGrid : public VolumeGl, public testing::WithParamInterface<Grid> {};

TEST_P(VolumeGlGrid, AgreesWithTheTruth) {
  const auto volume = gl_test::volume_of(GetParam());
  for (const bool inside : {false, true}) {
    const VolumeView view = gl_test::view_of(volume->sector, inside);
    for (const bool haze : {false, true}) {
      const double db = against_truth(volume, gl_test::table_of(haze), view, {.step_samples = 0.5});
      EXPECT_GE(db, 40.0) << GetParam().name << (inside ? ", inside" : ", outside") << (haze ? ", haze" : "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, VolumeGlGrid, testing::ValuesIn(gl_test::grids()),
                         [](const auto& grid) { return grid.param.name; });

TEST_P(VolumeGlGrid, AgreesWithTheProcessor) {
  const auto volume = gl_test::volume_of(GetParam());
  const auto masks = two_masks(volume->sv.shape());
  const auto cpu = make_cpu_renderer();
  ASSERT_TRUE(cpu->set_volume(volume));
  ASSERT_TRUE(cpu->set_transfer(gl_test::table_of(true)));
  ASSERT_TRUE(cpu->set_masks(masks));
  for (const RayMode mode : {RayMode::accumulate, RayMode::first_hit, RayMode::maximum}) {
    VolumeView view = gl_test::view_of(volume->sector);
    view.mode = mode;
    view.first_hit_db = -55.0;
    view.lighting.on = mode == RayMode::first_hit;
    const auto there = cpu->draw(view, {}, work_);
    ASSERT_TRUE(there);
    const double db = psnr_db(on_black(*there), on_black(drawn(volume, gl_test::table_of(true), view, {}, masks)));
    EXPECT_GE(db, mode == RayMode::accumulate ? 42.0 : 32.0) << GetParam().name << " mode " << static_cast<int>(mode);
  }
}

struct Kind {
  const char* name;
  RayMode mode;
  bool lit, masked, data, gaps;
  double least_db;
};

class VolumeGlKind : public VolumeGl, public testing::WithParamInterface<Kind> {};

TEST_P(VolumeGlKind, AgreesWithTheTruth) {
  const Kind kind = GetParam();
  const Grid& grid = grid_named("uneven");
  const auto volume = kind.gaps ? with_gaps(grid) : gl_test::volume_of(grid);
  VolumeView view = gl_test::view_of(volume->sector);
  view.mode = kind.mode;
  view.first_hit_db = -55.0;
  view.lighting.on = kind.lit;
  view.masks.data_too = kind.data;
  const auto masks = kind.masked ? two_masks(volume->sv.shape()) : std::vector<MaskLayer>{};
  const double db = against_truth(volume, gl_test::table_of(false), view, {.step_samples = 0.25}, masks);
  EXPECT_GE(db, kind.least_db);
}

// Surfaces have sharp outlines, where a pixel's ray meets them or not: there the bounds are lower.
INSTANTIATE_TEST_SUITE_P(Kinds, VolumeGlKind,
                         testing::Values(Kind{"lit", RayMode::accumulate, true, false, true, false, 45.0},
                                         Kind{"gaps", RayMode::accumulate, false, false, true, true, 45.0},
                                         Kind{"first_hit", RayMode::first_hit, false, false, true, false, 36.0},
                                         Kind{"first_hit_lit", RayMode::first_hit, true, false, true, false, 32.0},
                                         Kind{"first_hit_gaps", RayMode::first_hit, false, false, true, true, 32.0},
                                         Kind{"maximum", RayMode::maximum, false, false, true, false, 36.0},
                                         Kind{"maximum_gaps", RayMode::maximum, false, false, true, true, 36.0},
                                         Kind{"masks_alone", RayMode::accumulate, false, true, false, false, 36.0},
                                         Kind{"masks_alone_lit", RayMode::accumulate, true, true, false, false, 34.0},
                                         Kind{"masks_and_data", RayMode::accumulate, false, true, true, false, 36.0},
                                         Kind{"masks_and_gaps", RayMode::accumulate, true, true, true, true, 34.0},
                                         Kind{"masks_first_hit", RayMode::first_hit, true, true, true, false, 32.0},
                                         Kind{"masks_maximum", RayMode::maximum, false, true, true, false, 34.0}),
                         [](const auto& kind) { return kind.param.name; });

TEST_F(VolumeGl, SchoolsThatOverlapAgreeWithTheTruth) {
  const auto volume = gl_test::volume_of(grid_named("uneven"));
  const auto masks = overlapping_masks(volume->sv.shape());
  VolumeView view = gl_test::view_of(volume->sector);
  for (const bool data_too : {false, true}) {
    view.masks.data_too = data_too;
    EXPECT_GE(against_truth(volume, gl_test::table_of(false), view, {.step_samples = 0.25}, masks), 36.0) << data_too;
  }
}

TEST_F(VolumeGl, AnOpaqueThingEndsTheRay) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  VolumeView view = gl_test::view_of(volume->sector);
  std::vector<float> metres(view.size.count());
  for (std::size_t i = 0; i < metres.size(); ++i) metres[i] = i % 64 < 32 ? 250.0F : INFINITY;
  const RayImage open = drawn(volume, gl_test::table_of(false), view);
  view.opaque_m = std::make_shared<const std::vector<float>>(metres);
  EXPECT_GE(against_truth(volume, gl_test::table_of(false), view, {.step_samples = 0.5}), 45.0);
  EXPECT_GT(largest_step(open, drawn(volume, gl_test::table_of(false), view)), 20.0);
}

TEST_F(VolumeGl, AnOpaqueRayHasTheWholeColour) {
  // Rays end at 99 % opacity; the hundredth that they have not seen must not darken them (2.5 steps of 255).
  auto volume = gl_test::volume_of(grid_named("even"));
  for (auto& sv : volume->sv.all()) sv = static_cast<std::int16_t>(std::lround(counts_from_db(-30.0)));
  const OpticalTable flat{-90.0, -20.0, {{0.25F, 0.5F, 0.75F, 0.3F}, {0.25F, 0.5F, 0.75F, 0.3F}}};
  int opaque = 0;
  for (const auto& p : drawn(volume, flat, gl_test::view_of(volume->sector)).rgba) {
    EXPECT_TRUE(p[3] == 1.0F || p[3] < 0.99F) << p[3];
    if (p[3] < 1.0F) continue;
    ++opaque;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p[c], flat.rgb_extinction[0][c], 1e-3);
  }
  EXPECT_GT(opaque, 100);
}

TEST_F(VolumeGl, AHalvedPictureHasThePixelsOfTheFullOne) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  const VolumeView view = gl_test::view_of(volume->sector);
  const RayImage full = drawn(volume, gl_test::table_of(true), view);
  const RayImage half = drawn(volume, gl_test::table_of(true), view, {.divisor = 3});
  ASSERT_EQ(half.size, (PixelSize{22, 16}));
  for (int y = 0; y < half.size.height; ++y) {
    for (int x = 0; x < half.size.width; ++x) {
      const int fx = full_pixel(x, 3, 64);
      const int fy = full_pixel(y, 3, 48);
      const auto& small = half.rgba[static_cast<std::size_t>(y * 22 + x)];
      const auto& large = full.rgba[static_cast<std::size_t>(fy * 64 + fx)];
      // The last digits may differ: the software driver computes pixels in groups, and those are others here.
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(small[c], large[c], 1.0 / 255.0) << x << ' ' << y;
    }
  }
}

TEST_F(VolumeGl, JitteredFramesAverageToTheTruth) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  const VolumeView view = gl_test::view_of(volume->sector);
  const OpticalTable table = gl_test::table_of(false);
  VolumeView fine = view;
  fine.size = {4 * view.size.width, 4 * view.size.height};  // frames take other places in a pixel
  const RayImage truth = scenes::reduced(brute_force(*volume, table, {}, fine, 0.125, work_), 4);
  const auto gl = renderer();
  ASSERT_TRUE(gl->set_volume(volume));
  ASSERT_TRUE(gl->set_transfer(table));
  RayImage mean = drawn(*gl, view, {.step_samples = 4.0, .jitter_frame = 1});
  const double one = psnr_db(on_black(truth), on_black(drawn(*gl, view, {.step_samples = 4.0})));
  for (std::uint32_t frame = 2; frame <= 16; ++frame) {
    const RayImage next = drawn(*gl, view, {.step_samples = 4.0, .jitter_frame = frame});
    for (std::size_t i = 0; i < mean.rgba.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c)
        mean.rgba[i][c] += (next.rgba[i][c] - mean.rgba[i][c]) / static_cast<float>(frame);
    }
  }
  EXPECT_GT(psnr_db(on_black(truth), on_black(mean)), one + 8.0) << "16 frames halve the error more than once";
}

TEST_F(VolumeGl, ThinCellsChangeLittle) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  const VolumeView view = gl_test::view_of(volume->sector);
  const RayImage exact = drawn(volume, gl_test::table_of(true), view, {.homogeneous_limit = 0.0});
  const RayImage quick = drawn(volume, gl_test::table_of(true), view, {.homogeneous_limit = 0.03});
  EXPECT_GE(psnr_db(on_black(exact), on_black(quick)), 50.0);
  EXPECT_GT(largest_step(exact, quick), 0.0) << "no cell was thin";
}

TEST_F(VolumeGl, TheSameAfterOthersHaveDrawn) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  const auto masks = two_masks(volume->sv.shape());
  const auto gl = renderer();
  ASSERT_TRUE(gl->set_volume(volume));
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(true)));
  ASSERT_TRUE(gl->set_masks(masks));
  const RayImage before = drawn(*gl, gl_test::view_of(volume->sector));
  gl_test::spoil_state();
  ASSERT_TRUE(gl->set_volume(volume));
  gl_test::spoil_state();
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(true)));
  gl_test::spoil_state();
  ASSERT_TRUE(gl->set_masks(masks));
  gl_test::spoil_state();
  EXPECT_EQ(drawn(*gl, gl_test::view_of(volume->sector)).rgba, before.rgba);
}

TEST_F(VolumeGl, TheSameInAContextMadeAnew) {
  const auto volume = gl_test::volume_of(grid_named("even"));
  const VolumeView view = gl_test::view_of(volume->sector);
  const RayImage before = drawn(volume, gl_test::table_of(true), view);
  context_ = ContextEgl();
  auto again = ContextEgl::make({4, 1});
  ASSERT_TRUE(again);
  context_ = std::move(*again);
  ASSERT_TRUE(context_.make_current());
  EXPECT_EQ(drawn(volume, gl_test::table_of(true), view).rgba, before.rgba);
}

TEST_F(VolumeGl, StatesCanBeSetAnewInAnyOrder) {
  const auto first = gl_test::volume_of(grid_named("even"));
  const auto second = gl_test::volume_of(grid_named("wide"));
  const auto gl = renderer();
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(false, 1024)));
  ASSERT_TRUE(gl->set_volume(first));
  ASSERT_TRUE(gl->set_masks(two_masks(first->sv.shape())));
  (void)drawn(*gl, gl_test::view_of(first->sector));
  ASSERT_TRUE(gl->set_volume(second));
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(true, 2)));
  (void)drawn(*gl, gl_test::view_of(second->sector));
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(true)));
  const VolumeView view = gl_test::view_of(second->sector);
  EXPECT_EQ(drawn(*gl, view).rgba, drawn(second, gl_test::table_of(true), view).rgba);
}

TEST_F(VolumeGl, MissingOrWrongInputIsOneClearLine) {
  const auto gl = renderer();
  const auto volume = gl_test::volume_of(grid_named("even"));
  VolumeView view = gl_test::view_of(volume->sector);
  EXPECT_EQ(gl->draw(view, {}, work_).error().code, ErrorCode::bad_parameter);
  EXPECT_FALSE(gl->set_volume(nullptr));
  EXPECT_FALSE(gl->set_masks({}));
  auto unknown = gl_test::volume_of(grid_named("even"));
  for (auto& sv : unknown->sv.all()) sv = kNoData;
  const auto no_data = gl->set_volume(unknown);
  ASSERT_FALSE(no_data);
  EXPECT_EQ(to_line(no_data.error()).find('\n'), std::string::npos);
  EXPECT_NE(no_data.error().text.find("a ping without data"), std::string::npos);
  ASSERT_TRUE(gl->set_volume(volume));
  EXPECT_NE(gl->draw(view, {}, work_).error().text.find("no transfer table"), std::string::npos);
  EXPECT_EQ(gl->set_transfer({-90.0, -20.0, {{1, 1, 1, 1}}}).error().code, ErrorCode::bad_parameter);
  EXPECT_FALSE(gl->set_transfer({-90.0, -20.0, {{1, 1, 1, 1}, {1, 1, 1, NAN}}}));
  ASSERT_TRUE(gl->set_transfer(gl_test::table_of(false)));
  ASSERT_TRUE(gl->draw(view, {}, work_));
  view.size = {0, 10};
  EXPECT_EQ(gl->draw(view, {}, work_).error().code, ErrorCode::bad_parameter);
  Work stopped(1);
  stopped.cancel();
  view.size = {16, 16};
  EXPECT_EQ(gl->draw(view, {}, stopped).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace sonar
