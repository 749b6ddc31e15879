// SPDX-License-Identifier: Apache-2.0
#include "geo/sound_ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Warm above a thermocline, a channel's axis at 60 m, pressure below.
const SoundProfile kSummer{{0, 1505}, {15, 1503}, {25, 1488}, {60, 1478}, {110, 1481}, {200, 1483.5}};

RayPlace after(const SoundProfile& profile, double depth_m, double elevation_deg, double time_s) {
  SoundRay ray(profile, depth_m, elevation_deg * kDegree);
  ray.advance(time_s);
  return ray.place();
}

double speed_at(const SoundProfile& profile, double depth_m) {
  if (depth_m <= profile.front().depth_m) return profile.front().sound_speed_mps;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (depth_m > profile[i].depth_m) continue;
    const double share = (depth_m - profile[i - 1].depth_m) / (profile[i].depth_m - profile[i - 1].depth_m);
    return profile[i - 1].sound_speed_mps + share * (profile[i].sound_speed_mps - profile[i - 1].sound_speed_mps);
  }
  return profile.back().sound_speed_mps;
}

/// The eikonal equations in small steps of the middle point: knows nothing of arcs, layers or turning points.
RayPlace by_steps(const SoundProfile& profile, double depth_m, double elevation_deg, double time_s) {
  constexpr int kSteps = 40'000;
  const double h = time_s / kSteps;
  double x = 0.0;
  double z = depth_m;
  double dip = -elevation_deg * kDegree;
  const auto turn = [&](double at_m, double at_dip) {
    constexpr double kNear_m = 1e-4;
    const double g = (speed_at(profile, at_m + kNear_m) - speed_at(profile, at_m - kNear_m)) / (2 * kNear_m);
    return -g * std::cos(at_dip);
  };
  for (int i = 0; i < kSteps; ++i) {
    const double half_z = z + h / 2 * speed_at(profile, z) * std::sin(dip);
    const double half_dip = dip + h / 2 * turn(z, dip);
    x += h * speed_at(profile, half_z) * std::cos(half_dip);
    z += h * speed_at(profile, half_z) * std::sin(half_dip);
    dip += h * turn(half_z, half_dip);
  }
  return {x, z, -dip, speed_at(profile, z)};
}

TEST(SoundRay, IsStraightWhereSpeedDoesNotChange) {
  for (const double elevation_deg : {-90.0, -45.0, 0.0, 10.0, 90.0}) {
    const RayPlace at = after({{0, 1500}, {100, 1500}}, 7.0, elevation_deg, 0.3);
    EXPECT_NEAR(at.distance_m, 450 * std::cos(elevation_deg * kDegree), 1e-4) << elevation_deg;
    EXPECT_NEAR(at.depth_m, 7 - 450 * std::sin(elevation_deg * kDegree), 1e-4) << elevation_deg;
  }
}

// By hand: a level ray in c = 1500 - 0.1 z lies on the circle of radius c / g = 14 993 m, and 500 m on it is 8.34 m lower:
// R (1 - cos(s / R)). Sound slows down as it sinks: the time for the arc is artanh(sin(s / R)) / g.
TEST(SoundRay, LevelRayOnItsCircle) {
  constexpr double kGradient = 0.1;
  const SoundProfile falling{{0, 1500}, {200, 1500 - 200 * kGradient}};
  const double speed = 1500 - 7 * kGradient;
  const double radius = speed / kGradient;
  const double turned = 500.0 / radius;
  const RayPlace at = after(falling, 7.0, 0.0, std::atanh(std::sin(turned)) / kGradient);
  EXPECT_NEAR(at.depth_m - 7.0, radius * (1.0 - std::cos(turned)), 1e-6);
  EXPECT_NEAR(at.depth_m - 7.0, 8.34, 0.01);
  EXPECT_NEAR(at.distance_m, radius * std::sin(turned), 1e-6);
  EXPECT_NEAR(at.elevation_rad, -turned, 1e-9);
}

// By hand: dipping by a, where speed rises with depth, a ray is back at its depth after 2 R sin a along the level with
// R = c / (g cos a), as steep upwards; it has been R (1 - cos a) deeper.
TEST(SoundRay, TurnsBackAtItsLowestPoint) {
  constexpr double kGradient = 0.05;
  const SoundProfile rising{{0, 1450}, {400, 1450 + 400 * kGradient}};
  const double dip = 1.0 * kDegree;
  const double speed = 1450 + 100 * kGradient;
  const double radius = speed / (kGradient * std::cos(dip));
  const double half_s = std::asinh(std::tan(dip)) / kGradient;
  const RayPlace lowest = after(rising, 100, -1.0, half_s);
  EXPECT_NEAR(lowest.depth_m - 100, radius * (1 - std::cos(dip)), 1e-6);
  EXPECT_NEAR(lowest.elevation_rad, 0.0, 1e-12);
  const RayPlace back = after(rising, 100, -1.0, 2 * half_s);
  EXPECT_NEAR(back.depth_m, 100, 1e-6);
  EXPECT_NEAR(back.distance_m, 2 * radius * std::sin(dip), 1e-5);
  EXPECT_NEAR(back.elevation_rad, dip, 1e-9);
}

TEST(SoundRay, IsTheEikonalsThroughLayersAndTurningPoints) {
  for (const double elevation_deg : {-60.0, -20.0, -8.0, -3.0, -0.5, 0.0, 0.7, 4.0, 30.0}) {
    for (const double depth_m : {7.0, 20.0, 61.0}) {
      const RayPlace exact = after(kSummer, depth_m, elevation_deg, 0.34);
      const RayPlace stepped = by_steps(kSummer, depth_m, elevation_deg, 0.34);
      EXPECT_NEAR(exact.distance_m, stepped.distance_m, 0.05) << elevation_deg << " from " << depth_m;
      EXPECT_NEAR(exact.depth_m, stepped.depth_m, 0.05) << elevation_deg << " from " << depth_m;
    }
  }
}

// Laws: cos(elevation) / c stays; the way back is the way there; pieces make the whole.
TEST(SoundRay, KeepsSnellsInvariantAndComesBack) {
  for (const double elevation_deg : {-80.0, -10.0, -2.0, 0.0, 3.0, 15.0}) {
    for (const double depth_m : {7.0, 25.0, 60.0, 150.0}) {
      const RayPlace at = after(kSummer, depth_m, elevation_deg, 0.5);
      EXPECT_NEAR(std::cos(at.elevation_rad) / at.sound_speed_mps * speed_at(kSummer, depth_m),
                  std::cos(elevation_deg * kDegree), 1e-9);
      EXPECT_NEAR(at.sound_speed_mps, speed_at(kSummer, at.depth_m), 1e-6);
      SoundRay back(kSummer, at.depth_m, -at.elevation_rad);
      SoundRay pieces(kSummer, depth_m, elevation_deg * kDegree);
      for (int i = 0; i < 50; ++i) pieces.advance(0.01);
      back.advance(0.5);
      EXPECT_NEAR(back.place().distance_m, at.distance_m, 1e-3) << elevation_deg << " from " << depth_m;
      EXPECT_NEAR(back.place().depth_m, depth_m, 1e-3) << elevation_deg << " from " << depth_m;
      EXPECT_NEAR(pieces.place().depth_m, at.depth_m, 1e-6);
      EXPECT_NEAR(pieces.place().distance_m, at.distance_m, 1e-6);
    }
  }
}

// Along the axis of a channel a level ray stays, beside it the ray is held; from the crest of a fast layer it leaves.
TEST(SoundRay, LevelRaysGoToWhereSoundIsSlower) {
  EXPECT_DOUBLE_EQ(after(kSummer, 60, 0.0, 1.0).depth_m, 60.0);
  EXPECT_NEAR(after(kSummer, 60, 0.01, 1.0).depth_m, 60.0, 0.1);
  const SoundProfile crest{{0, 1480}, {50, 1490}, {100, 1480}};
  EXPECT_GT(after(crest, 50, 0.0, 0.3).depth_m, 60.0);
  EXPECT_GT(after({{0, 1500}, {10, 1490}}, 0.0, 0.0, 0.3).depth_m, 5.0);
  EXPECT_LT(after({{10, 1490}, {20, 1500}}, 20.0, 0.0, 0.3).depth_m, 15.0);
  EXPECT_DOUBLE_EQ(after({{10, 1490}}, 10.0, 0.0, 0.3).depth_m, 10.0);
}

}  // namespace
}  // namespace sonar
