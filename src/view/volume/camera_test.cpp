// SPDX-License-Identifier: Apache-2.0
#include "view/volume/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

TEST(Camera, WhatIsZoomedAboutStaysInItsPlace) {
  const Camera camera{{-300.0, 120.0, -80.0}, {20.0, -200.0, 60.0}};
  const Point<Sonar> about{-40.0, -90.0, 30.0};
  const Camera nearer = zoomed_about(camera, about, 0.25);
  const auto was = basis(camera, {640, 480}).project(about);
  const auto is = basis(nearer, {640, 480}).project(about);
  ASSERT_TRUE(was && is);
  EXPECT_NEAR(is->pixel.x, was->pixel.x, 1e-7);
  EXPECT_NEAR(is->pixel.y, was->pixel.y, 1e-7);
  EXPECT_NEAR(is->depth_m, 0.25 * was->depth_m, 1e-9);
  EXPECT_NEAR(norm(nearer.eye - about), 0.25 * norm(camera.eye - about), 1e-9);
}

TEST(Camera, SidesShowTheWholeSectorAndTheShip) {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int i = 0; i < 6; ++i) elevation.push_back(rad_from_deg(-45.0 + 9.0 * i));
  for (int i = 0; i < 7; ++i) azimuth.push_back(rad_from_deg(240.0 + 10.0 * i));
  const Sector sector(elevation, azimuth, {0.0, 0.5, 1000});
  const PixelSize size{640, 480};
  for (const double bow_deg : {0.0, 90.0, 180.0, 270.0}) {
    const Camera camera = seen_from(sector, Sector::direction(0.0, rad_from_deg(bow_deg)), size);
    EXPECT_NEAR(camera.eye.z, camera.target.z, 1e-9) << "level";
    const CameraBasis b = basis(camera, size);
    std::vector<Point<Sonar>> all{{30.0, 0.0, -20.0}, {-30.0, 0.0, -20.0}};
    for (const int fan : {0, 5}) {
      for (const int beam : {0, 3, 6}) all.push_back(sector.centre(fan, beam, 999));
    }
    for (const Point<Sonar>& point : all) {
      const auto seen = b.project(point);
      ASSERT_TRUE(seen) << bow_deg;
      EXPECT_TRUE(seen->pixel.x > 0.0 && seen->pixel.x < 640.0 && seen->pixel.y > 0.0 && seen->pixel.y < 480.0)
          << bow_deg << ": " << seen->pixel.x << " " << seen->pixel.y;
    }
  }
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

/// Sector of a span of azimuths and 30 degrees of elevation.
Sector sector_of(double span_deg, double middle_deg, double elevation_deg, double first_m) {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int i = 0; i < 7; ++i) elevation.push_back(rad_from_deg(elevation_deg - 9.0 + 3.0 * i));
  for (int i = 0; i < 21; ++i) azimuth.push_back(rad_from_deg(middle_deg + span_deg * (i / 20.0 - 0.5)));
  return {elevation, azimuth, {first_m, 0.5, 800}};
}

/// Part of the picture that the sector and the ship take, the larger of width and height; over 1 where one is outside.
double part_taken(const Sector& sector, PixelSize size) {
  const CameraBasis b = basis(overview(sector, size), size);
  std::vector<Point<Sonar>> points{{0.0, 0.0, 0.0}};
  for (const double elevation : {sector.elevation_bounds(0).lower, sector.elevation_bounds(sector.fans() - 1).upper}) {
    const double first = sector.azimuth_bounds(0).lower;
    const double last = sector.azimuth_bounds(sector.beams() - 1).upper;
    for (int i = 0; i <= 200; ++i) {
      for (const int sample : {0, sector.range().count - 1}) {
        points.push_back(Sector::direction(elevation, first + (last - first) * i / 200.0) *
                         sector.range().range_m(sample));
      }
    }
  }
  double left = 1e9;
  double right = -1e9;
  double top = 1e9;
  double bottom = -1e9;
  for (const Point<Sonar>& p : points) {
    const auto seen = b.project(p);
    if (!seen) return 1e9;
    left = std::min(left, seen->pixel.x);
    right = std::max(right, seen->pixel.x);
    top = std::min(top, seen->pixel.y);
    bottom = std::max(bottom, seen->pixel.y);
  }
  if (left < 0.0 || top < 0.0 || right > size.width || bottom > size.height) return 1e9;
  return std::max((right - left) / size.width, (bottom - top) / size.height);
}

TEST(Camera, OverviewFitsTheShipAndSectorsOfAnyWidth) {
  for (const double span_deg : {20.0, 60.0, 150.0, 200.0, 360.0}) {
    for (const double elevation_deg : {-80.0, -45.0, -20.0, 0.0, 45.0, 80.0}) {
      for (const double middle_deg : {270.0, 0.0, 450.0}) {
        for (const double first_m : {-0.4, 100.0}) {
          for (const PixelSize size : {PixelSize{1024, 768}, PixelSize{300, 900}}) {
            const double part = part_taken(sector_of(span_deg, middle_deg, elevation_deg, first_m), size);
            EXPECT_TRUE(part > 0.6 && part <= 1.0)
                << part << " of the picture: span " << span_deg << ", elevation " << elevation_deg << ", azimuth "
                << middle_deg << ", from " << first_m << " m, width " << size.width;
          }
        }
      }
    }
  }
}

TEST(Camera, OverviewFitsTwoBeamsWhoseCellsBulge) {
  const Sector two({rad_from_deg(-10.0), rad_from_deg(0.0)}, {rad_from_deg(0.0), rad_from_deg(90.0)}, {0.0, 0.5, 100});
  const double part = part_taken(two, {640, 480});
  EXPECT_TRUE(part > 0.6 && part <= 1.0) << part;
}

}  // namespace
}  // namespace sonar
