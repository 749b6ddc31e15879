// SPDX-License-Identifier: Apache-2.0
#include "view/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

TEST(Camera, LooksWhereItIsTold) {
  // From the port side towards starboard, level: the bow is to the left, down is down.
  const Camera camera{{0.0, -100.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, rad_from_deg(90.0)};
  const CameraBasis b = basis(camera, {200, 100});
  const auto bow = b.project({50.0, 0.0, 0.0});
  const auto down = b.project({0.0, 0.0, 50.0});
  ASSERT_TRUE(bow && down);
  EXPECT_NEAR(bow->pixel.x, 75.0, 1e-9) << "50 m at 100 m is half of the half height of 50 pixels";
  EXPECT_NEAR(bow->pixel.y, 50.0, 1e-9);
  EXPECT_NEAR(down->pixel.x, 100.0, 1e-9);
  EXPECT_NEAR(down->pixel.y, 75.0, 1e-9);
  EXPECT_NEAR(down->depth_m, 100.0, 1e-9);
  EXPECT_FALSE(b.project({0.0, -150.0, 0.0})) << "behind the eye";
}

TEST(Camera, RaysAndProjectionAgree) {
  const Camera camera{{-300.0, 120.0, -80.0}, {20.0, -200.0, 60.0}};
  const CameraBasis b = basis(camera, {640, 480});
  for (const PixelPoint pixel : {PixelPoint{0.5, 0.5}, PixelPoint{600.0, 17.0}, PixelPoint{320.0, 240.0}}) {
    const Ray ray = b.ray(pixel);
    EXPECT_NEAR(norm(ray.direction), 1.0, 1e-12);
    const auto seen = b.project(ray.origin + ray.direction * 123.0);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->pixel.x, pixel.x, 1e-7);
    EXPECT_NEAR(seen->pixel.y, pixel.y, 1e-7);
  }
}

TEST(Camera, ABasisIsOrthonormalEvenWhereTheCameraIsNot) {
  const Point<Sonar> origin{0.0, 0.0, 0.0};
  const Point<Sonar> up{0.0, 0.0, -1.0};
  for (const Camera& camera :
       {Camera{{1, 2, 3}, {4, -5, 6}}, Camera{origin, origin, up}, Camera{{0, 0, -9}, origin, up},
        Camera{{0, 0, 9}, origin, up}, Camera{{1, 2, 3}, {4, 5, 6}, origin}}) {
    const CameraBasis b = basis(camera, {10, 10});
    for (const Point<Sonar>& v : {b.right, b.up, b.forward}) EXPECT_NEAR(norm(v), 1.0, 1e-12);
    EXPECT_NEAR(dot(b.right, b.up), 0.0, 1e-12);
    EXPECT_NEAR(dot(b.right, b.forward), 0.0, 1e-12);
    EXPECT_NEAR(dot(b.up, b.forward), 0.0, 1e-12);
  }
}

TEST(Camera, OrbitKeepsDistanceAndNeverTurnsOver) {
  Camera camera{{100.0, 50.0, -30.0}, {10.0, 20.0, 5.0}};
  const double distance = norm(camera.eye - camera.target);
  EXPECT_NEAR(norm(orbited(camera, 2.0 * std::numbers::pi, 0.0).eye - camera.eye), 0.0, 1e-9);
  camera = orbited(camera, 0.3, 9.0);
  EXPECT_NEAR(norm(camera.eye - camera.target), distance, 1e-9);
  EXPECT_LT(camera.eye.z, camera.target.z) << "above, not over the top";
  EXPECT_NEAR(norm(zoomed(camera, 0.5).eye - camera.target), 0.5 * distance, 1e-9);
  const Camera moved = panned(camera, 0.1, -0.2);
  EXPECT_NEAR(norm((moved.eye - moved.target) - (camera.eye - camera.target)), 0.0, 1e-9);
}

TEST(Camera, OverviewShowsTheWholeSector) {
  for (const double middle : {270.0, 90.0, 0.0}) {
    std::vector<double> elevation;
    std::vector<double> azimuth;
    for (int i = 0; i < 20; ++i) elevation.push_back(rad_from_deg(-45.0 + 2.3 * i));
    for (int i = 0; i < 25; ++i) azimuth.push_back(rad_from_deg(middle - 30.0 + 2.5 * i));
    const Sector sector(elevation, azimuth, {0.0, 0.38, 1319});
    const PixelSize size{1024, 768};
    const CameraBasis b = basis(overview(sector), size);
    for (int fan = 0; fan < 20; ++fan) {
      for (int beam = 0; beam < 25; ++beam) {
        for (const int sample : {0, 600, 1318}) {
          const auto seen = b.project(sector.centre(fan, beam, sample));
          ASSERT_TRUE(seen);
          EXPECT_TRUE(seen->pixel.x > 0 && seen->pixel.x < size.width && seen->pixel.y > 0 &&
                      seen->pixel.y < size.height)
              << seen->pixel.x << ' ' << seen->pixel.y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sonar
