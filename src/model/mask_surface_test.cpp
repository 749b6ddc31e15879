// SPDX-License-Identifier: Apache-2.0
#include "model/mask_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

Sector sector(int samples = 400) {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int i = 0; i < 40; ++i) elevation.push_back(rad_from_deg(-60.0 + 1.5 * i));
  for (int i = 0; i < 60; ++i) azimuth.push_back(rad_from_deg(230.0 + 1.5 * i));
  return {elevation, azimuth, {0.0, 0.5, samples}};
}

/// A ball whose confidence falls from 1 to 0 over `soft_m`, one half at its radius.
PingMask ball(const Sector& in, const Point<Sonar>& middle, double radius_m, double soft_m, double hollow_m = 0.0) {
  PingMask mask;
  for (int row = 0; row < in.fans() * in.beams(); ++row) {
    for (int s = 0; s < in.range().count; ++s) {
      const double away = norm(in.centre(row / in.beams(), row % in.beams(), s) - middle);
      const double depth = hollow_m > 0.0 ? std::min(radius_m - away, away - hollow_m) : radius_m - away;
      const double confidence = std::min(1.0, depth / soft_m + 0.5);
      if (confidence <= 0.0) continue;
      if (!mask.runs.empty() && mask.runs.back().row == row && mask.runs.back().end() == s) {
        ++mask.runs.back().count;
      } else {
        mask.runs.push_back({row, s, 1});
      }
      mask.confidence.push_back(quantised_confidence(confidence));
    }
  }
  return mask;
}

/// Every edge is used once in each direction.
void expect_closed(const SurfaceMesh<Sonar>& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NE(t[i], t[(i + 1) % 3]);
      ++uses[{t[i], t[(i + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : uses) {
    ASSERT_EQ(count, 1) << edge.first << " to " << edge.second;
    ASSERT_TRUE(uses.contains({edge.second, edge.first})) << edge.first << " to " << edge.second << " gapes";
  }
}

Point<Sonar> middle_of(const Sector& in) { return in.centre(20, 30, 240); }

TEST(MaskSurface, OfABallEnclosesItsVolume) {
  const Sector in = sector();
  const auto mesh = mask_surface(ball(in, middle_of(in), 20.0, 8.0), in);
  expect_closed(mesh);
  const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * 8000.0;
  EXPECT_NEAR(enclosed_volume_m3(mesh) / ball_m3, 1.0, 0.02) << "positive: oriented outward";
  // V - E + F of a sphere.
  EXPECT_EQ(static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2, 2);
  for (const auto& v : mesh.vertices) EXPECT_NEAR(norm(v - middle_of(in)), 20.0, 1.0);
}

TEST(MaskSurface, AHollowHasASurfaceOfItsOwn) {
  const Sector in = sector();
  const auto mesh = mask_surface(ball(in, middle_of(in), 24.0, 6.0, 12.0), in);
  expect_closed(mesh);
  const double shell_m3 = 4.0 / 3.0 * std::numbers::pi * (24.0 * 24.0 * 24.0 - 12.0 * 12.0 * 12.0);
  EXPECT_NEAR(enclosed_volume_m3(mesh) / shell_m3, 1.0, 0.03);
  EXPECT_EQ(static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2, 4) << "two spheres";
}

TEST(MaskSurface, ABlockAtTheSectorsCornerEndsAtItsCells) {
  const Sector in = sector();
  PingMask mask;
  for (int fan = 0; fan < 12; ++fan) {
    for (int beam = 0; beam < 12; ++beam) mask.runs.push_back({fan * in.beams() + beam, 300, 100});
  }
  mask.confidence.assign(12UL * 12UL * 100UL, 255);
  const auto mesh = mask_surface(mask, in);
  expect_closed(mesh);
  double cells_m3 = 0.0;
  for (const sonar::Run& run : mask.runs) {
    for (int s = run.first_sample; s < run.end(); ++s) cells_m3 += in.volume_m3(run.row / 60, run.row % 60, s);
  }
  // Bevelled edges take off some: along an edge of n cells about an eighth of a cell's section for each.
  EXPECT_NEAR(enclosed_volume_m3(mesh) / cells_m3, 0.99, 0.01);
  double farthest = 0.0;
  for (const auto& v : mesh.vertices) farthest = std::max(farthest, norm(v));
  EXPECT_NEAR(farthest, 399.5 * 0.5, 0.01) << "half a sample behind the last";
}

TEST(MaskSurface, VoxelsThatTouchAtACornerLeaveNoGap) {
  const Sector in = sector();
  PingMask mask;
  mask.runs = {{10 * 60 + 10, 100, 1}, {10 * 60 + 11, 101, 1}, {11 * 60 + 10, 101, 1}, {11 * 60 + 11, 100, 1}};
  mask.confidence = {255, 200, 130, 255};
  expect_closed(mask_surface(mask, in));
}

TEST(MaskSurface, WhatNobodyIsSureOfHasNone) {
  const Sector in = sector();
  EXPECT_TRUE(mask_surface({}, in).triangles.empty());
  PingMask faint;
  faint.runs = {{10 * 60 + 10, 100, 5}};
  faint.confidence.assign(5, 127);
  EXPECT_TRUE(mask_surface(faint, in).triangles.empty());
}

}  // namespace
}  // namespace sonar
