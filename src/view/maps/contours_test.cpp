// SPDX-License-Identifier: Apache-2.0
#include "view/maps/contours.h"

#include <gtest/gtest.h>

#include <cmath>

#include "view/maps/depth_layer.h"

namespace sonar {
namespace {

template <class F>
ScalarField field(int width, int height, const F& f) {
  ScalarField out;
  out.size = {width, height};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out.values.push_back(static_cast<float>(f(x, y)));
  }
  return out;
}

TEST(Contours, APlaneHasOneStraightLineFromEdgeToEdge) {
  const auto lines = contour_lines(field(20, 10, [](int x, int) { return 2.0 * x; }), 13.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(lines[0].points.size(), 10U);
  for (const PixelPoint& p : lines[0].points) EXPECT_DOUBLE_EQ(p.x, 6.5);
}

TEST(Contours, AConeHasOneClosedCircle) {
  const auto lines = contour_lines(field(41, 41, [](int x, int y) { return std::hypot(x - 20.0, y - 20.0); }), 12.3);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_GT(lines[0].points.size(), 60U);
  for (const PixelPoint& p : lines[0].points) EXPECT_NEAR(std::hypot(p.x - 20.0, p.y - 20.0), 12.3, 0.02);
}

TEST(Contours, ASaddleIsToldByItsMean) {
  // Two high corners on the diagonal. A mean above the level joins them: the two low corners are cut off.
  const auto joined = contour_lines(field(2, 2, [](int x, int y) { return x == y ? 9.0 : 0.0; }), 4.0);
  ASSERT_EQ(joined.size(), 2U);
  for (const ContourLine& line : joined) {
    ASSERT_EQ(line.points.size(), 2U);
    // Both ends near one low corner, (1, 0) or (0, 1).
    const double x = (line.points[0].x + line.points[1].x) / 2.0;
    const double y = (line.points[0].y + line.points[1].y) / 2.0;
    EXPECT_GT(std::abs(x - y), 0.3);
  }
}

TEST(Contours, NothingIsDrawnThroughTheUnknown) {
  const auto lines = contour_lines(field(20, 10, [](int x, int y) { return y == 5 ? std::nan("") : 2.0 * x; }), 13.0);
  EXPECT_EQ(lines.size(), 2U);
}

TEST(DepthBands, LevelsAreRoundAndHoldAllDepths) {
  const DepthBands bands =
      depth_bands(field(30, 1, [](int x, int) { return 83.0 + 10.0 * x; }), light_theme({800, 600}));
  ASSERT_GE(bands.levels_m.size(), 3U);
  EXPECT_LE(bands.levels_m.front(), 83.0);
  EXPECT_GE(bands.levels_m.back(), 373.0);
  EXPECT_EQ(bands.map.knots.size(), bands.levels_m.size() - 1);
  for (const double v : bands.levels_m) EXPECT_EQ(std::fmod(v, 50.0), 0.0);
  EXPECT_EQ(bands.colour(bands.levels_m[1] + 0.1), bands.map.knots[1]);
  EXPECT_EQ(bands.colour(bands.levels_m[1] - 0.1), bands.map.knots[0]);
  EXPECT_FALSE(bands.land);
  EXPECT_FALSE(bands.unknown);
}

TEST(DepthBands, LandAndUnknownAreNoticedAndALevelSeaHasABand) {
  const Theme theme = light_theme({800, 600});
  EXPECT_TRUE(depth_bands(field(3, 1, [](int x, int) { return x == 0 ? -5.0 : 50.0; }), theme).land);
  EXPECT_TRUE(depth_bands(field(3, 1, [](int x, int) { return x == 0 ? std::nan("") : 50.0; }), theme).unknown);
  EXPECT_GE(depth_bands(field(3, 1, [](int, int) { return 50.0; }), theme).levels_m.size(), 2U);
  EXPECT_TRUE(depth_bands(field(3, 1, [](int, int) { return std::nan(""); }), theme).levels_m.empty());
}

}  // namespace
}  // namespace sonar
