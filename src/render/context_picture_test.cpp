// SPDX-License-Identifier: Apache-2.0
#include "render/context_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/units.h"
#include "view/theme.h"

namespace sonar {
namespace {

/// Looks from 100 m aft towards the bow; field of view 90 degrees.
const Camera kFromAft{{-100.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, rad_from_deg(90.0)};
constexpr PixelSize kSize{200, 200};
constexpr Rgba8 kBlack{0, 0, 0, 255};
constexpr Rgba8 kRed{255, 0, 0, 255};
constexpr Rgba8 kGreen{0, 255, 0, 255};

/// A square at x, from -half to half in y and z.
void add_square(std::vector<SceneTriangle>& to, double x, double half, Rgba8 colour) {
  to.push_back({{Point<Sonar>{x, -half, -half}, {x, half, -half}, {x, half, half}}, colour});
  to.push_back({{Point<Sonar>{x, -half, -half}, {x, half, half}, {x, -half, half}}, colour});
}

TEST(ContextPicture, AFaceHasItsPlaceSizeAndDistance) {
  ContextScene scene;
  add_square(scene.opaque, 0.0, 50.0, kRed);
  Work work(2);
  const ContextPicture picture = draw_context(scene, kFromAft, kSize, {kBlack}, -7.0, work);
  int red = 0;
  for (const Rgba8& p : picture.behind.pixels) red += p == kRed ? 1 : 0;
  EXPECT_EQ(red, 100 * 100) << "50 m at 100 m fills half of a 90 degree view each way";
  ASSERT_TRUE(picture.opaque_m);
  const auto metres = [&](int x, int y) { return (*picture.opaque_m)[picture.behind.index(x, y)]; };
  EXPECT_NEAR(metres(100, 100), 100.0, 0.01);
  EXPECT_NEAR(metres(140, 120), 100.0 * std::sqrt(1.0 + 0.405 * 0.405 + 0.205 * 0.205), 0.5);
  EXPECT_TRUE(std::isinf(metres(10, 10)));
}

TEST(ContextPicture, TheNearerHidesTheFartherInAnyOrder) {
  for (const bool near_first : {true, false}) {
    ContextScene scene;
    add_square(scene.opaque, near_first ? -20.0 : 30.0, 30.0, near_first ? kRed : kGreen);
    add_square(scene.opaque, near_first ? 30.0 : -20.0, 30.0, near_first ? kGreen : kRed);
    Work work(1);
    const ContextPicture picture = draw_context(scene, kFromAft, kSize, {kBlack}, -7.0, work);
    EXPECT_EQ(picture.behind.at(100, 100), kRed);
  }
}

// Tracks and trails are hidden by echoes, and change no colour of other lines.
TEST(ContextPicture, WhatLiesUnderChangesNoOpaqueEcho) {
  ContextScene scene;
  scene.lines.push_back({{0.0, -40.0, 10.0}, {0.0, 40.0, 10.0}, kGreen, 3.0});
  Work work(1);
  const ContextPicture without = draw_context(scene, kFromAft, kSize, {kBlack}, -7.0, work);
  scene.under.push_back({{0.0, -40.0, -10.0}, {500.0, 40.0, -10.0}, kRed, 3.0});
  scene.under.push_back({{0.0, -40.0, 10.0}, {0.0, 40.0, 10.0}, kRed, 3.0});
  const ContextPicture with = draw_context(scene, kFromAft, kSize, {kBlack}, -7.0, work);
  EXPECT_FALSE(with.behind.pixels == without.behind.pixels) << "it is there";
  EXPECT_TRUE(with.front.pixels == without.front.pixels);
  const std::vector<std::array<float, 4>> echoes(kSize.count(), {0.2F, 0.4F, 0.6F, 1.0F});
  const RayImage rays{kSize, echoes, {}};
  EXPECT_TRUE(between(with, rays, work).pixels == between(without, rays, work).pixels);
  int green = 0;
  for (std::size_t i = 0; i < kSize.count(); ++i) {
    if (without.behind.pixels[i] != kGreen) continue;
    ++green;
    EXPECT_EQ(with.behind.pixels[i], kGreen) << "other lines lie over it";
  }
  EXPECT_GT(green, 50);
}

TEST(ContextPicture, TheSeaLiesOnTheEyesSide) {
  ContextScene scene;
  add_square(scene.translucent, 0.0, 50.0, {0, 0, 255, 100});
  Work work(1);
  Camera camera = kFromAft;
  camera.eye.z = -20.0;
  const ContextPicture above = draw_context(scene, camera, kSize, {kBlack}, -7.0, work);
  EXPECT_EQ(above.behind.at(100, 100), kBlack);
  EXPECT_EQ(above.front.at(100, 100).a, 100);
  camera.eye.z = 20.0;
  const ContextPicture below = draw_context(scene, camera, kSize, {kBlack}, -7.0, work);
  EXPECT_EQ(below.front.at(100, 100).a, 0);
  EXPECT_GT(below.behind.at(100, 100).b, 90);
}

TEST(ContextPicture, WhatIsBehindTheEyeIsCutOff) {
  ContextScene scene;
  // A plane that passes under the eye and goes on behind it.
  scene.opaque.push_back({{Point<Sonar>{-500.0, -300.0, 10.0}, {500.0, 0.0, 10.0}, {-500.0, 300.0, 10.0}}, kGreen});
  Work work(1);
  const ContextPicture picture = draw_context(scene, kFromAft, kSize, {kBlack}, -7.0, work);
  EXPECT_EQ(picture.behind.at(100, 199), kGreen);
  EXPECT_EQ(picture.behind.at(100, 50), kBlack) << "nothing above the horizon";
}

TEST(ContextPicture, RaysLieBetweenTheLayers) {
  const PixelSize size{64, 50};
  ContextPicture context{Image(size, {10, 200, 30, 255}), Image(size, {0, 0, 0, 0}), nullptr};
  RayImage rays{size, std::vector<std::array<float, 4>>(size.count()), {}};
  for (int i = 0; i < 64; ++i) {
    for (int y = 10; y < 50; ++y) {
      const float a = static_cast<float>(i) / 64.0F;
      rays.rgba[context.behind.index(i, y)] = {a * 0.9F, a * 0.2F, a * 0.1F, a};
      context.front.at(i, y) = {200, 100, 50, static_cast<std::uint8_t>(y > 30 ? 5 * y : 0)};
    }
  }
  Work work(2);
  const Image between_them = between(context, rays, work);
  EXPECT_EQ(between_them, over(context.front, over(rays, context.behind)));
  EXPECT_EQ(between_them.at(5, 5), (Rgba8{10, 200, 30, 255})) << "nothing lies there";
  // Half of (0.9, 0.2, 0.1) over the ground: 0.45 255 + 0.5 10, ...
  EXPECT_EQ(between_them.at(32, 20), (Rgba8{120, 126, 28, 255}));
}

TEST(ContextPicture, AnyNumberOfThreadsDrawsTheSame) {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int i = 0; i < 6; ++i) elevation.push_back(rad_from_deg(-45.0 + 9.0 * i));
  for (int i = 0; i < 7; ++i) azimuth.push_back(rad_from_deg(240.0 + 10.0 * i));
  const Sector sector(elevation, azimuth, {0.0, 0.5, 1000});
  SeabedPatch bed{20, 20, -600.0, -600.0, 60.0, std::vector<float>(400, 300.0F)};
  bed.depth_m[7] = std::nanf("");
  const ContextScene scene = context_scene(sector, {}, dark_theme({320, 240}), bed);
  Work one(1);
  Work four(4);
  const Camera camera = overview(sector, {320, 240});
  const ContextPicture a = draw_context(scene, camera, {320, 240}, {kBlack}, -7.0, one);
  const ContextPicture b = draw_context(scene, camera, {320, 240}, {kBlack}, -7.0, four);
  EXPECT_EQ(a.behind, b.behind);
  EXPECT_EQ(a.front, b.front);
  EXPECT_EQ(*a.opaque_m, *b.opaque_m);
}

}  // namespace
}  // namespace sonar
