// SPDX-License-Identifier: Apache-2.0
// Masks are where they are, whichever samples a ray takes: a shell round the transducer has an answer by geometry alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/gl/gl_test_scene.h"
#include "render/gl/test_both_back_ends.h"
#include "render/ray_rules.h"
#include "render/test_scenes.h"

namespace sonar {
namespace {

using gl_test::drawn;
using gl_test::mean_of;

class Masks : public gl_test::EitherBackEnd {};
INSTANTIATE_TEST_SUITE_P(BackEnds, Masks, testing::Bool(), gl_test::name_of);

constexpr int kFirst = 60;  // samples of the shell
constexpr int kLast = 89;
constexpr double kOpacityPerM = 0.15;

/// All of the fan between two ranges, sure of itself.
std::vector<MaskLayer> shell(Shape3 shape) {
  PingMask mask;
  for (int row = 0; row < shape.fans * shape.beams; ++row) {
    mask.runs.push_back({row, kFirst, kLast - kFirst + 1});
    mask.confidence.insert(mask.confidence.end(), kLast - kFirst + 1, 255);
  }
  return {{std::make_shared<const PingMask>(std::move(mask)), {1.0F, 1.0F, 1.0F}}};
}

/// Where between two samples, one of a mask and one of none, a confidence lies, m from the transducer.
double rim_m(const Sector& sector, double confidence, bool near) {
  const RangeAxis& range = sector.range();
  return near ? range.range_m(kFirst - 1) + confidence * range.spacing_m
              : range.range_m(kLast + 1) - confidence * range.spacing_m;
}

/// From the middle of the fan in front of the shell, outwards: no ray leaves by its sides within it.
VolumeView outwards(const Sector& sector) {
  VolumeView view;
  const Point<Sonar> along = Sector::direction(rad_from_deg(-22.0), 0.0);
  view.camera = scenes::looking(along * (0.6 * sector.range().range_m(kFirst)), along * 100.0 + Point<Sonar>{0, 9, 4});
  view.camera.vertical_fov_rad = 0.5;
  view.size = {64, 48};
  view.masks.data_too = false;
  return view;
}

/// Metres from the eye to a sphere round the transducer, from within.
double to_sphere_m(const Ray& ray, double radius_m) {
  const double along = ray.origin.x * ray.direction.x + ray.origin.y * ray.direction.y + ray.origin.z * ray.direction.z;
  return -along + std::sqrt(along * along - std::pow(norm(ray.origin), 2) + radius_m * radius_m);
}

Ray ray_of(const VolumeView& view, int x, int y, std::uint32_t frame) {
  const PixelPoint shift = pixel_shift(frame);
  return basis(view.camera, view.size).ray({x + 0.5 + shift.x, y + 0.5 + shift.y});
}

/// A core takes what its length says, in every frame: no rings of as many samples.
TEST_P(Masks, ACoreIsAsDeepAsItIsLong) {
  const auto volume = scenes::volume(scenes::fan());
  const Sector& sector = volume->sector;
  VolumeView view = outwards(sector);
  view.masks.fuzzy_opacity = 0.0F;
  for (const RayMode mode : {RayMode::accumulate, RayMode::maximum}) {
    view.mode = mode;
    for (const std::uint32_t frame : {0U, 1U, 2U}) {
      const RayImage rays =
          drawn(renderer(), volume, scenes::table(false), view, {1, 1.0, 0.03, frame}, shell(volume->sv.shape()));
      const auto core_at = static_cast<double>(view.masks.core_at);
      for (int y = 0; y < view.size.height; ++y) {
        for (int x = 0; x < view.size.width; ++x) {
          const Ray ray = ray_of(view, x, y, frame);
          const double metres =
              to_sphere_m(ray, rim_m(sector, core_at, false)) - to_sphere_m(ray, rim_m(sector, core_at, true));
          const auto at = static_cast<std::size_t>(y * view.size.width + x);
          const double expected = -std::expm1(-kOpacityPerM * metres);
          ASSERT_NEAR(static_cast<double>(rays.rgba[at][3]), expected, 0.001) << x << ", " << y << ", " << frame;
        }
      }
    }
  }
}

/// The surface lies where the confidence is reached: depth tells by its colour.
TEST_P(Masks, ASurfaceLiesWhereItIsReached) {
  const auto volume = scenes::volume(scenes::fan());
  const Sector& sector = volume->sector;
  VolumeView view = outwards(sector);
  view.masks.fuzzy_above = 0.5F;
  view.masks.fuzzy_opacity = 1.0F;
  view.cue = {{0, 0, 0, 255}, 8.0, 16.0};
  for (const std::uint32_t frame : {0U, 1U, 2U}) {
    const RayImage rays =
        drawn(renderer(), volume, scenes::table(false), view, {1, 1.0, 0.03, frame}, shell(volume->sv.shape()));
    const CameraBasis camera = basis(view.camera, view.size);
    for (int y = 0; y < view.size.height; ++y) {
      for (int x = 0; x < view.size.width; ++x) {
        const Ray ray = ray_of(view, x, y, frame);
        const Point<Sonar> seen = ray.direction * to_sphere_m(ray, rim_m(sector, 0.5, true));
        const double depth = seen.x * camera.forward.x + seen.y * camera.forward.y + seen.z * camera.forward.z;
        const auto at = static_cast<std::size_t>(y * view.size.width + x);
        ASSERT_NEAR(static_cast<double>(rays.rgba[at][0]), 1.0 - view.cue.pale(depth), 0.001)
            << x << ", " << y << ", " << frame;
      }
    }
  }
}

/// Before a surface within a core lies as much of it as the way there is long.
TEST_P(Masks, ACoreEndsAtASurfaceWithinIt) {
  auto volume = scenes::volume(scenes::fan(), 0.0);
  const Sector& sector = volume->sector;
  // Sv rises evenly along range; its level lies elsewhere between samples than the mask's.
  for (int row = 0; row < sector.fans() * sector.beams(); ++row) {
    const auto sv = volume->sv.view().row(row);
    for (std::size_t s = 0; s < sv.size(); ++s) {
      sv[s] = static_cast<std::int16_t>(std::lround(counts_from_db(-90.0 + 0.5 * static_cast<double>(s))));
    }
  }
  VolumeView view = outwards(sector);
  view.masks.data_too = true;
  view.masks.fuzzy_opacity = 0.0F;
  view.mode = RayMode::first_hit;
  view.first_hit_db = -55.15;  // between samples 69 and 70
  OpticalTable black{-90.0, -20.0, {{0.0F, 0.0F, 0.0F, 0.1F}, {0.0F, 0.0F, 0.0F, 0.1F}}};
  // OpenGL looks for the level from the start of its cell on: half a step late where it lies before that.
  const double most = GetParam() ? 0.003 + 0.5 * kOpacityPerM * 0.5 * sector.range().spacing_m : 0.003;
  for (const std::uint32_t frame : {0U, 2U}) {
    const RayImage rays = drawn(renderer(), volume, black, view, {1, 1.0, 0.03, frame}, shell(volume->sv.shape()));
    const double hit_m = sector.range().range_m(0) + (-55.15 + 90.0) / 0.5 * sector.range().spacing_m;
    const double core_m = rim_m(sector, static_cast<double>(view.masks.core_at), true);
    for (int y = 0; y < view.size.height; ++y) {
      for (int x = 0; x < view.size.width; ++x) {
        const Ray ray = ray_of(view, x, y, frame);
        const double metres = to_sphere_m(ray, hit_m) - to_sphere_m(ray, core_m);
        const auto& p = rays.rgba[static_cast<std::size_t>(y * view.size.width + x)];
        ASSERT_EQ(p[3], 1.0F);
        ASSERT_NEAR(static_cast<double>(p[0]), -std::expm1(-kOpacityPerM * metres), most) << x << ", " << y;
      }
    }
  }
}

/// The mean of sixteen frames is a picture of sixteen rays a pixel, with masks too.
TEST_P(Masks, FramesAtRestSmoothNoiseBehindMasks) {
  const auto volume = scenes::volume(scenes::fan(), 12.0);
  const auto masks = gl_test::overlapping_masks(volume->sv.shape());
  const Rgba8 black{0, 0, 0, 255};
  for (const RayMode mode : {RayMode::first_hit, RayMode::maximum, RayMode::accumulate}) {
    VolumeView seen;
    seen.camera = overview(scenes::fan());
    seen.size = {72, 54};
    seen.first_hit_db = -74.0;
    seen.mode = mode;
    seen.masks.data_too = mode != RayMode::accumulate;  // where they add up samples move
    VolumeView fine = seen;
    fine.size = {288, 216};
    const auto optics = scenes::table(true);
    const Image truth = over(scenes::reduced(drawn(renderer(), volume, optics, fine, {}, masks), 4), black);
    const Image mean = over(mean_of(renderer(), volume, optics, seen, 16, masks), black);
    EXPECT_GT(psnr_db(mean, truth), 45.0) << static_cast<int>(mode);
    EXPECT_GT(worst_tile_psnr_db(mean, truth), 35.0) << static_cast<int>(mode);
    EXPECT_LT(psnr_db(over(drawn(renderer(), volume, optics, seen, {}, masks), black), truth), 45.0)
        << "one ray a pixel has steps";
  }
}

}  // namespace
}  // namespace sonar
