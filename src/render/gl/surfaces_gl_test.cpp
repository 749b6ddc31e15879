// SPDX-License-Identifier: Apache-2.0
// What the picture of a surface must be by geometry alone, whichever back-end draws it. Balls whose Sv falls by so many dB
// a metre from their middle on reach the level exactly at their radius.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/gl/test_both_back_ends.h"
#include "render/ray_rules.h"
#include "render/reference/brute_force.h"
#include "render/test_scenes.h"

namespace sonar {
namespace {

using gl_test::drawn;
using gl_test::mean_of;

constexpr double kLevel_db = -50.0;

struct Ball {
  Point<Sonar> middle;
  double radius_m;
  double fall_db_per_m;  ///< below 0: a cavity
};

Sector fine_fan() { return {scenes::even(-40.0, 0.0, 41), scenes::even(-30.0, 30.0, 61), RangeAxis{0.0, 0.25, 281}}; }
/// The middle of the sector.
Point<Sonar> centre() { return Sector::direction(rad_from_deg(-20.0), 0.0) * 40.0; }

/// The largest of the balls' Sv; -80 dB at least.
std::shared_ptr<VolumeData> balls(const std::vector<Ball>& all) {
  const Sector sector = fine_fan();
  auto out = std::make_shared<VolumeData>(
      VolumeData{sector, Array3<std::int16_t>({sector.fans(), sector.beams(), sector.range().count}), -1e9});
  for (int f = 0; f < sector.fans(); ++f) {
    for (int b = 0; b < sector.beams(); ++b) {
      for (int s = 0; s < sector.range().count; ++s) {
        double db = -80.0;
        for (const Ball& ball : all) {
          const double beyond_m = norm(sector.centre(f, b, s) - ball.middle) - ball.radius_m;
          db = std::max(db, std::min(-20.0, kLevel_db - ball.fall_db_per_m * beyond_m));
        }
        out->sv(f, b, s) = static_cast<std::int16_t>(std::lround(counts_from_db(db)));
      }
    }
  }
  return out;
}

/// White where the level is reached, another colour before it; an even extinction in both.
OpticalTable table(float below_per_m = 0.0F, float above_per_m = 0.0F) {
  OpticalTable out{-90.0, -10.0, {}};
  for (int i = 0; i < 801; ++i) {
    const bool above = -90.0 + 0.1 * i >= kLevel_db - 0.25;
    out.rgb_extinction.push_back(above ? std::array{1.0F, 1.0F, 1.0F, above_per_m}
                                       : std::array{0.2F, 0.4F, 0.6F, below_per_m});
  }
  return out;
}

/// From `metres` before the middle of the sector, seen from the side; half a radian from edge to edge.
VolumeView view(double metres, RayMode mode) {
  VolumeView out;
  out.camera = scenes::looking(centre() + Point<Sonar>{-0.3, 0.9, 0.3} * (metres / norm(Point<Sonar>{-0.3, 0.9, 0.3})),
                               centre());
  out.camera.vertical_fov_rad = 0.6;
  out.size = {96, 96};
  out.mode = mode;
  out.first_hit_db = kLevel_db;
  return out;
}

/// Where the ray through a pixel's middle meets the ball, metres from the eye; the ray's distance from its middle.
struct Meeting {
  double miss_m;
  double at_m;
  Point<Sonar> normal;
  double depth_m;
};
Meeting meeting(const VolumeView& view, int x, int y, const Ball& ball) {
  const CameraBasis camera = basis(view.camera, view.size);
  const Ray ray = camera.ray({x + 0.5, y + 0.5});
  const auto dot = [](const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const Point<Sonar> to = ball.middle - ray.origin;
  const double along = dot(to, ray.direction);
  Meeting out{std::sqrt(std::max(0.0, dot(to, to) - along * along)), 0.0, {}, 0.0};
  out.at_m = along - std::sqrt(std::max(0.0, ball.radius_m * ball.radius_m - out.miss_m * out.miss_m));
  out.normal = (ray.origin + ray.direction * out.at_m - ball.middle) * (1.0 / ball.radius_m);
  out.depth_m = out.at_m * dot(ray.direction, camera.forward);
  return out;
}

Ball lone_ball() { return {centre(), 8.0, 2.0}; }
/// The wall of a room round the middle.
Ball room() { return {centre(), 6.0, -2.0}; }

/// Light that shows the slope towards the lamp, or the sky, as the colour itself.
Lighting lamp_alone() { return {true, 0.0F, 1.0F, 0.0F, 0.1F, 0.0F}; }
Lighting sky_alone(float reach_m) { return {true, 1.0F, 0.0F, 0.0F, 0.1F, reach_m}; }

const std::array<float, 4>& pixel(const RayImage& image, int x, int y) {
  return image.rgba[static_cast<std::size_t>(y * image.size.width + x)];
}

class Surfaces : public gl_test::EitherBackEnd {};
INSTANTIATE_TEST_SUITE_P(BackEnds, Surfaces, testing::Bool(), gl_test::name_of);

/// A ball has the outline and the normals of a ball.
TEST_P(Surfaces, ABallIsRound) {
  VolumeRenderer& r = renderer();
  const Ball ball = lone_ball();
  const auto volume = balls({ball});
  for (const RayMode mode : {RayMode::first_hit, RayMode::volume_and_surface}) {
    VolumeView seen = view(45.0, mode);
    seen.lighting = lamp_alone();
    const RayImage rays = drawn(r, volume, table(), seen);
    const Point<Sonar> lamp = light_direction(basis(seen.camera, seen.size));
    double squares = 0.0;
    int met = 0;
    for (int y = 0; y < seen.size.height; ++y) {
      for (int x = 0; x < seen.size.width; ++x) {
        const Meeting at = meeting(seen, x, y, ball);
        if (std::abs(at.miss_m - ball.radius_m) < 0.05) continue;
        ASSERT_EQ(pixel(rays, x, y)[3], at.miss_m < ball.radius_m ? 1.0F : 0.0F) << x << ", " << y;
        // At the rim a slope seen from the side is known to within a cell.
        if (at.miss_m > 0.9 * ball.radius_m) continue;
        const double bright = std::max(0.0, at.normal.x * lamp.x + at.normal.y * lamp.y + at.normal.z * lamp.z);
        squares += std::pow(static_cast<double>(pixel(rays, x, y)[0]) - bright, 2);
        ++met;
      }
    }
    ASSERT_GT(met, 800);
    EXPECT_LT(std::sqrt(squares / met), 0.03) << "the slope is linear between samples 0.7 m apart, on 8 m of radius";
  }
}

/// All of the sky is seen from a convex body.
TEST_P(Surfaces, NothingDarkensALoneBall) {
  VolumeRenderer& r = renderer();
  VolumeView seen = view(45.0, RayMode::first_hit);
  seen.lighting = sky_alone(20.0F);
  const auto volume = balls({lone_ball()});
  for (const std::uint32_t frame : {0U, 1U, 5U}) {
    for (const auto& p : drawn(r, volume, table(), seen, {1, 1.0, 0.03, frame}).rgba) {
      if (p[3] == 0.0F) continue;
      ASSERT_NEAR(p[0], 1.0F, 0.02F) << frame;
    }
  }
}

/// From any place on the wall of a round room of radius a the wall lies 2 a cos off in a direction so far off the normal:
/// under the cosine law the mean is 4 a / 3. Linear between steps of 3 m a wall of 6 m radius is met a little early.
TEST_P(Surfaces, ARoundRoomIsAsDarkAsItIsWide) {
  VolumeRenderer& r = renderer();
  for (const float reach : {12.0F, 24.0F}) {
    VolumeView seen = view(1e-3, RayMode::first_hit);
    seen.lighting = sky_alone(reach);
    const auto volume = balls({room()});
    const double expected = 4.0 * room().radius_m / (3.0 * static_cast<double>(reach));
    const RayImage one = drawn(r, volume, table(), seen);
    const RayImage many = mean_of(r, volume, table(), seen, 16);
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
      ASSERT_EQ(one.rgba[i][3], 1.0F);
      ASSERT_NEAR(static_cast<double>(one.rgba[i][0]), expected, 0.06 * expected) << reach;
      ASSERT_NEAR(static_cast<double>(many.rgba[i][0]), expected, 0.05 * expected) << reach;
    }
  }
}

/// Between two balls that touch it is darker than on their far sides.
TEST_P(Surfaces, TwoBallsDarkenEachOther) {
  VolumeRenderer& r = renderer();
  const Point<Sonar> aside = basis(view(45.0, RayMode::first_hit).camera, {96, 96}).right * 5.0;
  const std::vector<Ball> two{{centre() - aside, 5.0, 2.0}, {centre() + aside, 5.0, 2.0}};
  VolumeView seen = view(45.0, RayMode::first_hit);
  seen.lighting = sky_alone(10.0F);
  const RayImage rays = mean_of(r, balls(two), table(), seen, 8);
  const auto column = [&](int x) { return pixel(rays, x, 48)[0]; };
  // 96 pixels see 2 x 45 tan 0.3 = 27.8 m.
  EXPECT_LT(column(45), 0.75F);
  EXPECT_LT(column(45), column(42) - 0.02F);
  EXPECT_GT(column(18), 0.97F);
  EXPECT_NEAR(column(45), column(50), 0.1F) << "both sides alike";
}

/// Water of an even extinction before the surface dims it by the exponential of the way through it.
TEST_P(Surfaces, ASurfaceStandsInItsWater) {
  VolumeRenderer& r = renderer();
  Ball ball = lone_ball();
  ball.fall_db_per_m = 20.0;  // so that no other Sv comes before the level
  const auto volume = balls({ball});
  VolumeView seen = view(20.0, RayMode::volume_and_surface);
  seen.size = {1, 1};
  seen.camera.vertical_fov_rad = 1e-4;
  for (const double limit : {0.0, 10.0}) {
    double mean = 0.0;
    for (std::uint32_t frame = 1; frame <= 16; ++frame) {
      mean +=
          static_cast<double>(drawn(r, volume, table(0.05F, 0.05F), seen, {1, 1.0, limit, frame}).rgba[0][0]) / 16.0;
    }
    const double left = std::exp(-0.05 * (20.0 - ball.radius_m));
    EXPECT_NEAR(mean, left * 1.0 + (1.0 - left) * 0.2, 0.005) << limit;
  }
}

/// Without water before it, it is the first hit; where nothing reaches the level, it is the volume.
TEST_P(Surfaces, ItIsBothOfWhatItIsMadeOf) {
  VolumeRenderer& r = renderer();
  const auto volume = balls({lone_ball()});
  VolumeView seen = view(45.0, RayMode::first_hit);
  seen.lighting.on = true;
  seen.lighting.occlusion_m = 10.0F;
  const RayImage hit = drawn(r, volume, table(), seen);
  seen.mode = RayMode::volume_and_surface;
  EXPECT_EQ(drawn(r, volume, table(), seen).rgba, hit.rgba);
  for (const bool lit : {false, true}) {
    seen.lighting.on = lit;
    seen.first_hit_db = 0.0;
    const Image both = over(drawn(r, volume, table(0.01F, 0.01F), seen), Rgba8{0, 0, 0, 255});
    seen.mode = RayMode::accumulate;
    EXPECT_GT(psnr_db(over(drawn(r, volume, table(0.01F, 0.01F), seen), Rgba8{0, 0, 0, 255}), both), 60.0);
    seen.mode = RayMode::volume_and_surface;
  }
}

/// A surface has as much of the background as its depth says; opacity stays.
TEST_P(Surfaces, WhatIsFarFades) {
  VolumeRenderer& r = renderer();
  const Ball ball = lone_ball();
  const auto volume = balls({ball});
  VolumeView seen = view(45.0, RayMode::first_hit);
  seen.cue = {{20, 40, 80, 255}, 36.0, 48.0};
  const RayImage rays = drawn(r, volume, table(), seen);
  for (int y = 0; y < seen.size.height; ++y) {
    for (int x = 0; x < seen.size.width; ++x) {
      const Meeting at = meeting(seen, x, y, ball);
      if (at.miss_m > 0.95 * ball.radius_m) continue;
      const double pale = seen.cue.pale(at.depth_m);
      ASSERT_NEAR(static_cast<double>(pixel(rays, x, y)[0]), 1.0 - pale + pale * 20.0 / 255.0, 0.01) << x << ", " << y;
    }
  }
  for (const RayMode mode : {RayMode::accumulate, RayMode::maximum, RayMode::volume_and_surface}) {
    seen.mode = mode;
    const RayImage with = drawn(r, volume, table(0.02F, 0.1F), seen);
    VolumeView bare = seen;
    bare.cue = {};
    const RayImage without = drawn(r, volume, table(0.02F, 0.1F), bare);
    Work work(2);
    const RayImage truth = brute_force(*volume, table(0.02F, 0.1F), {}, seen, 0.5, work);
    EXPECT_GT(psnr_db(over(with, Rgba8{0, 0, 0, 255}), over(truth, Rgba8{0, 0, 0, 255})), 40.0)
        << static_cast<int>(mode);
    for (std::size_t i = 0; i < with.rgba.size(); ++i) {
      ASSERT_NEAR(with.rgba[i][3], without.rgba[i][3], 1e-3F);
    }
  }
}

/// Lit surfaces in lit water, against the reference.
TEST_P(Surfaces, AgreesWithTheReference) {
  VolumeRenderer& r = renderer();
  const auto volume = scenes::volume(scenes::fan(), 0.5);
  VolumeView seen;
  seen.camera = overview(scenes::fan());
  seen.size = {48, 36};
  seen.first_hit_db = -55.0;
  Work work(2);
  for (const RayMode mode : {RayMode::first_hit, RayMode::volume_and_surface}) {
    for (const bool lit : {false, true}) {
      seen.mode = mode;
      seen.lighting.on = lit;
      seen.lighting.occlusion_m = 8.0F;
      const RayImage truth = brute_force(*volume, scenes::table(true), {}, seen, 0.125, work);
      const RayImage ours = drawn(r, volume, scenes::table(true), seen, {1, 0.125, 0.03, 0});
      EXPECT_GT(psnr_db(over(ours, Rgba8{0, 0, 0, 255}), over(truth, Rgba8{0, 0, 0, 255})), 33.0)
          << static_cast<int>(mode) << (lit ? ", lit" : "");
    }
  }
}

/// The mean of sixteen frames is a picture of sixteen rays a pixel.
TEST_P(Surfaces, FramesAtRestSmoothEdges) {
  VolumeRenderer& r = renderer();
  const auto volume = balls({lone_ball(), {centre() + Point<Sonar>{9.0, 4.0, -6.0}, 5.0, 3.0}});
  for (const RayMode mode : {RayMode::first_hit, RayMode::maximum}) {
    VolumeView seen = view(45.0, mode);
    seen.size = {192, 192};
    VolumeView fine = seen;
    fine.size = {768, 768};
    const Rgba8 black{0, 0, 0, 255};
    const Image truth = over(scenes::reduced(drawn(r, volume, table(0.0F, 1.0F), fine), 4), black);
    const Image mean = over(mean_of(r, volume, table(0.0F, 1.0F), seen, 16), black);
    EXPECT_GT(psnr_db(mean, truth), 45.0) << static_cast<int>(mode);
    EXPECT_GT(worst_tile_psnr_db(mean, truth), 35.0) << static_cast<int>(mode);
    EXPECT_LT(psnr_db(over(drawn(r, volume, table(0.0F, 1.0F), seen), black), truth), 40.0)
        << "one ray a pixel has steps";
  }
}

/// So it is in noise, where nearly every pixel has an edge.
TEST_P(Surfaces, FramesAtRestSmoothNoise) {
  VolumeRenderer& r = renderer();
  const auto volume = scenes::volume(scenes::fan(), 12.0);
  const Rgba8 black{0, 0, 0, 255};
  for (const RayMode mode : {RayMode::first_hit, RayMode::maximum}) {
    VolumeView seen;
    seen.camera = overview(scenes::fan());
    seen.size = {96, 72};
    seen.first_hit_db = -74.0;
    seen.mode = mode;
    VolumeView fine = seen;
    fine.size = {384, 288};
    const Image truth = over(scenes::reduced(drawn(r, volume, scenes::table(true), fine), 4), black);
    const Image mean = over(mean_of(r, volume, scenes::table(true), seen, 16), black);
    EXPECT_GT(psnr_db(mean, truth), 45.0) << static_cast<int>(mode);
    EXPECT_GT(worst_tile_psnr_db(mean, truth), 35.0) << static_cast<int>(mode);
    EXPECT_LT(psnr_db(over(drawn(r, volume, scenes::table(true), seen), black), truth), 35.0)
        << "one ray a pixel is noise";
  }
}

/// Both back-ends look for the same light in the same frame.
TEST_P(Surfaces, AgreesWithTheProcessorFrameByFrame) {
  if (!GetParam()) GTEST_SKIP() << "the processor against itself";
  const auto cpu = make_cpu_renderer();
  VolumeView seen = view(45.0, RayMode::volume_and_surface);
  seen.lighting = sky_alone(10.0F);
  const std::vector<Ball> two{lone_ball(), {centre() + Point<Sonar>{7.0, 7.0, 0.0}, 4.0, 2.0}};
  for (const std::uint32_t frame : {0U, 3U}) {
    const DrawQuality quality{1, 1.0, 0.03, frame};
    const Image ours = over(drawn(renderer(), balls(two), table(0.01F, 0.01F), seen, quality), Rgba8{0, 0, 0, 255});
    EXPECT_GT(psnr_db(over(drawn(*cpu, balls(two), table(0.01F, 0.01F), seen, quality), Rgba8{0, 0, 0, 255}), ours),
              45.0)
        << frame;
  }
}

}  // namespace
}  // namespace sonar
