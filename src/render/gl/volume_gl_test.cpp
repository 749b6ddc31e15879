// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "render/gl/context_egl.h"
#include "render/gl/fold_plan.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/gl_test_scene.h"
#include "render/gl/gl_version.h"
#include "render/ray_rules.h"
#include "render/reference/brute_force.h"
#include "render/test_scenes.h"

namespace sonar {
namespace {

using gl_test::Grid;
using gl_test::on_black;
using gl_test::overlapping_masks;
using gl_test::two_masks;

/// A context of its own for each test; skipped where none can be had.
class VolumeGl : public testing::Test {
 protected:
  void SetUp() override {
    auto made = ContextEgl::make();
    if (!made) GTEST_SKIP() << "no OpenGL here: " << made.error().text;
    context_ = std::move(*made);
    ASSERT_TRUE(context_.make_current());
  }
  ContextEgl context_;
  Work work_{2};

  std::unique_ptr<VolumeRenderer> renderer(const GlRendererOptions& options = {}) {
    auto made = make_gl_renderer(options);
    EXPECT_TRUE(made) << (made ? "" : made.error().text);
    return made ? std::move(*made) : nullptr;
  }

  RayImage drawn(VolumeRenderer& gl, const VolumeView& view, const DrawQuality& quality = {}) {
    auto image = gl.draw(view, quality, work_);
    EXPECT_TRUE(image) << (image ? "" : image.error().text);
    return image ? std::move(*image) : RayImage{};
  }

  RayImage drawn(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table, const VolumeView& view,
                 const DrawQuality& quality = {}, std::span<const MaskLayer> masks = {},
                 const GlRendererOptions& options = {}) {
    const auto gl = renderer(options);
    EXPECT_TRUE(gl->set_volume(volume));
    EXPECT_TRUE(gl->set_transfer(table));
    EXPECT_TRUE(gl->set_masks(masks));
    return drawn(*gl, view, quality);
  }

  double against_truth(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table,
                       const VolumeView& view, const DrawQuality& quality = {}, std::span<const MaskLayer> masks = {}) {
    const RayImage truth = brute_force(*volume, table, masks, view, 0.25, work_);
    EXPECT_GT(std::count_if(truth.rgba.begin(), truth.rgba.end(), [](const auto& p) { return p[3] > 0.1F; }),
              static_cast<std::ptrdiff_t>(truth.rgba.size() / 300))
        << "nothing to be seen";
    return psnr_db(on_black(truth), on_black(drawn(volume, table, view, quality, masks)));
  }
};

const Grid& grid_named(std::string_view name) {
  const auto& all = gl_test::grids();
  return *std::find_if(all.begin(), all.end(), [&](const Grid& g) { return g.name == name; });
}

/// Largest difference of any channel, in steps of 8 bits.
double largest_step(const RayImage& a, const RayImage& b) {
  double largest = a.size == b.size ? 0.0 : 1e9;
  for (std::size_t i = 0; largest < 1e9 && i < a.rgba.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      largest =
          std::max(largest, 255.0 * std::abs(static_cast<double>(a.rgba[i][c]) - static_cast<double>(b.rgba[i][c])));
    }
  }
  return largest;
}

/// Every 7th beam's far half and a block of samples are missing.
std::shared_ptr<VolumeData> with_gaps(const Grid& grid) {
  auto out = gl_test::volume_of(grid);
  const Shape3 n = out->sv.shape();
  for (int f = 0; f < n.fans; ++f) {
    for (int b = 0; b < n.beams; ++b) {
      for (int s = 0; s < n.samples; ++s) {
        const bool lost =
            (b % 7 == 3 && 2 * s > n.samples) || (f > n.fans / 2 && s > n.samples / 2 && s < n.samples * 2 / 3);
        if (lost) out->sv(f, b, s) = kNoData;
      }
    }
  }
  return out;
}

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
