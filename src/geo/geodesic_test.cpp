// SPDX-License-Identifier: Apache-2.0
#include "geo/geodesic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// WGS 84: semi-major axis and first eccentricity squared.
constexpr double kAxis_m = 6378137.0;
constexpr double kEccentricity2 = 0.0066943799901413165;

// One degree along the equator is a * pi / 180; the quarter meridian of WGS 84 is 10 001 965.729 m (published).
TEST(Geodesic, KnownDistances) {
  EXPECT_NEAR(geodesic({0, 10}, {0, 11}).distance_m, kAxis_m * kDegree, 1e-6);
  EXPECT_NEAR(geodesic({0, 10}, {0, 11}).bearing_deg, 90.0, 1e-12);
  EXPECT_NEAR(geodesic({0, 10}, {90, 10}).distance_m, 10001965.729, 1e-3);
  EXPECT_NEAR(geodesic({1, 10}, {0, 10}).bearing_deg, 180.0, 1e-12);
  EXPECT_EQ(geodesic({70, 5}, {70, 5}).distance_m, 0.0);
}

TEST(Geodesic, AcrossTheDateLine) {
  const GeodesicStep step = geodesic({0, 179.5}, {0, -179.5});
  EXPECT_NEAR(step.distance_m, kAxis_m * kDegree, 1e-6);
  EXPECT_NEAR(step.bearing_deg, 90.0, 1e-12);
  const Geographic there = destination({0, 179.5}, kAxis_m * kDegree, 90.0);
  EXPECT_NEAR(there.longitude_deg, -179.5, 1e-10);
  const Geographic back = destination({0, -179.5}, kAxis_m * kDegree, 270.0);
  EXPECT_NEAR(back.longitude_deg, 179.5, 1e-10);
}

// Radii of curvature by hand: one kilometre east at 70 N is 1000 / (N cos 70) rad of longitude, and the geodesic leaves
// the parallel southwards by d^2 tan(lat) / (2 N).
TEST(Geodesic, AtSeventyNorth) {
  const double s = std::sin(70 * kDegree);
  const double c = std::cos(70 * kDegree);
  const double n_m = kAxis_m / std::sqrt(1 - kEccentricity2 * s * s);
  const double m_m = n_m * (1 - kEccentricity2) / (1 - kEccentricity2 * s * s);
  const Geographic east = destination({70, 20}, 1000.0, 90.0);
  EXPECT_NEAR((east.longitude_deg - 20) * kDegree * n_m * c, 1000.0, 1e-3);
  EXPECT_NEAR((east.latitude_deg - 70) * kDegree * m_m, -1e6 * s / c / (2 * n_m), 1e-3);
  const Geographic north = destination({70, 20}, 1000.0, 0.0);
  EXPECT_NEAR((north.latitude_deg - 70) * kDegree * m_m, 1000.0, 1e-2);
  EXPECT_NEAR(north.longitude_deg, 20.0, 1e-12);
}

TEST(Geodesic, LocalFrameThereAndBack) {
  for (const Geographic& origin : {Geographic{0, 0}, {60, 5}, {70, -179.9999}, {-70, 179.9999}}) {
    for (const Point<Enu>& p : {Point<Enu>{300, 400, -20}, {-500, 20, 0}, {0, -450, 0}}) {
      const Point<Enu> back = to_enu(to_geographic(p, origin), origin);
      EXPECT_NEAR(back.x, p.x, 1e-6);
      EXPECT_NEAR(back.y, p.y, 1e-6);
      EXPECT_EQ(back.z, 0.0);
    }
  }
}

TEST(ConvexHull, SquareWithPointsInsideAndOnItsSides) {
  const std::vector<PlanePoint> hull = convex_hull({{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {0, 1}, {2, 2}});
  const std::vector<PlanePoint> expected{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(hull, expected);
}

TEST(ConvexHull, Degenerate) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}}).size(), 1U);
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 2U);
}

TEST(ConvexHull, EveryPointLiesLeftOfEverySide) {
  std::vector<PlanePoint> points;
  for (int i = 0; i < 200; ++i) points.push_back({std::sin(i * 1.7) * (i % 13), std::cos(i * 2.9) * (i % 7)});
  const std::vector<PlanePoint> hull = convex_hull(points);
  ASSERT_GE(hull.size(), 3U);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const PlanePoint& a = hull[k];
    const PlanePoint& b = hull[(k + 1) % hull.size()];
    for (const PlanePoint& p : points) {
      EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), -1e-9);
    }
  }
}

}  // namespace
}  // namespace sonar
