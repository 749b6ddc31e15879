// SPDX-License-Identifier: Apache-2.0
#include "session/slices/plane_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

using Kind = PlaneSlice::Kind;

const PlaneFrame kFrame{rad_from_deg(30.0), 7.0};

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point<Sonar> cross(const Point<Sonar>& a, const Point<Sonar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Signed: positive towards the viewer, who sees right at the right and down below.
double towards_viewer_m(const PlaneSlice& plane, const Point<Sonar>& p) {
  return -dot(p - plane.origin, cross(plane.right, plane.down));
}

PlanePlace of_kind(Kind kind) {
  PlanePlace place;
  place.lies = kind;
  place.bearing_deg = 100.0;
  place.tilt_deg = 35.0;
  place.offset_m = -20.0;
  place.depth_m = 60.0;
  return place;
}

Sector sector() { return {{-0.7, -0.4, -0.1}, {1.2, 1.5, 1.8}, {0.0, 2.0, 151}}; }

TEST(PlanePlaces, HorizontalIsAtItsDepth) {
  const PlaneSlice plane = plane_slice(of_kind(Kind::horizontal), kFrame);
  EXPECT_EQ(plane.kind, Kind::horizontal);
  EXPECT_DOUBLE_EQ(plane.origin.z, 53.0);  // 60 m below the surface, the transducer at 7 m
}

// By hand: heading 30, bearing 100: 70 degrees from the bow. The viewer stands at its right, at 160 degrees from the bow.
TEST(PlanePlaces, VerticalPointsAlongItsTrueBearing) {
  const PlaneSlice plane = plane_slice(of_kind(Kind::vertical), kFrame);
  EXPECT_NEAR(deg_from_rad(std::atan2(plane.right.y, plane.right.x)), 70.0, 1e-9);
  EXPECT_DOUBLE_EQ(plane.down.z, 1.0);
  const double azimuth = rad_from_deg(160.0);
  EXPECT_NEAR(plane.origin.x, -20.0 * std::cos(azimuth), 1e-9);
  EXPECT_NEAR(plane.origin.y, -20.0 * std::sin(azimuth), 1e-9);
}

// Law: 90 degrees of tilt make the vertical plane.
TEST(PlanePlaces, ObliqueIsVerticalWhereItIsSteepest) {
  PlanePlace steep = of_kind(Kind::oblique);
  steep.tilt_deg = 90.0;
  const PlaneSlice a = plane_slice(steep, kFrame);
  const PlaneSlice b = plane_slice(of_kind(Kind::vertical), kFrame);
  EXPECT_NEAR(norm(a.origin - b.origin), 0.0, 1e-9);
  EXPECT_NEAR(norm(a.right - b.right), 0.0, 1e-9);
  EXPECT_NEAR(norm(a.down - b.down), 0.0, 1e-9);
  const PlaneSlice leaning = plane_slice(of_kind(Kind::oblique), kFrame);
  EXPECT_NEAR(leaning.down.z, std::sin(rad_from_deg(35.0)), 1e-9);
}

TEST(PlanePlaces, LaidThroughAPointTheyHoldIt) {
  const Point<Sonar> p{40.0, 150.0, 60.0};
  for (const Kind kind : {Kind::horizontal, Kind::vertical, Kind::oblique}) {
    for (const PlanePlace& place : {laid_through(of_kind(kind), p, kFrame), moved_through(of_kind(kind), p, kFrame)}) {
      EXPECT_NEAR(towards_viewer_m(plane_slice(place, kFrame), p), 0.0, 1e-9);
      EXPECT_EQ(place.tilt_deg, 35.0);
    }
    EXPECT_EQ(moved_through(of_kind(kind), p, kFrame).bearing_deg, 100.0);
  }
  const PlaneSlice upright = plane_slice(laid_through(of_kind(Kind::vertical), p, kFrame), kFrame);
  EXPECT_NEAR(towards_viewer_m(upright, {}), 0.0, 1e-9) << "and through the sonar";
  const PlaneSlice leaning = plane_slice(laid_through(of_kind(Kind::oblique), p, kFrame), kFrame);
  EXPECT_GT(leaning.down.x * p.x + leaning.down.y * p.y, 0.0) << "it goes down away from the sonar";
}

TEST(PlanePlaces, AStepGoesUpOrAwayFromTheViewer) {
  for (const Kind kind : {Kind::vertical, Kind::oblique}) {
    const PlaneSlice before = plane_slice(of_kind(kind), kFrame);
    PlanePlace place = of_kind(kind);
    place.offset_m = 0.0;
    const PlanePlace moved = moved_by(place, 5.0, sector(), kFrame);
    EXPECT_NEAR(moved.offset_m, -5.0, 1e-9);
    EXPECT_NEAR(towards_viewer_m(before, plane_slice(moved, kFrame).origin), 15.0, 1e-9);
  }
  EXPECT_NEAR(moved_by(of_kind(Kind::horizontal), 5.0, sector(), kFrame).depth_m, 55.0, 1e-9);
}

// The deepest corner of the sector: half a fan below the lowest one, at the last sample's end.
TEST(PlanePlaces, StepsEndWhereTheSectorDoes) {
  const double deepest_m = 301.0 * std::sin(0.85) + 7.0;
  EXPECT_NEAR(moved_by(of_kind(Kind::horizontal), -1e4, sector(), kFrame).depth_m, deepest_m, 1e-6);
  PlanePlace beyond = of_kind(Kind::horizontal);
  beyond.depth_m = 2000.0;
  EXPECT_EQ(moved_by(beyond, -5.0, sector(), kFrame).depth_m, 2000.0);
  EXPECT_EQ(moved_by(beyond, 5.0, sector(), kFrame).depth_m, 1995.0) << "back is allowed";
}

TEST(PlanePlaces, TurnsAboutAPlaceThatStaysInIt) {
  const Point<Sonar> p{40.0, 150.0, 60.0};
  for (const Kind kind : {Kind::vertical, Kind::oblique}) {
    const PlanePlace place = moved_through(of_kind(kind), p, kFrame);
    const auto turned = turned_by(place, 300.0, p, kFrame);
    ASSERT_TRUE(turned);
    EXPECT_NEAR(turned->bearing_deg, 40.0, 1e-9);
    EXPECT_NEAR(towards_viewer_m(plane_slice(*turned, kFrame), p), 0.0, 1e-9);
  }
  EXPECT_FALSE(turned_by(of_kind(Kind::horizontal), 10.0, p, kFrame));
}

TEST(PlanePlaces, ASectionHoldsBothItsPlacesFromLeftToRight) {
  const Point<Sonar> a{100.0, 20.0, 0.0};
  const Point<Sonar> b{60.0, 180.0, 0.0};
  const auto place = vertical_through(of_kind(Kind::oblique), a, b, kFrame);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->lies, Kind::vertical);
  const PlaneSlice plane = plane_slice(*place, kFrame);
  EXPECT_NEAR(towards_viewer_m(plane, a), 0.0, 1e-9);
  EXPECT_NEAR(towards_viewer_m(plane, b), 0.0, 1e-9);
  EXPECT_GT(dot(b - a, plane.right), 0.0);
  EXPECT_FALSE(vertical_through({}, a, {100.0, 20.0, 50.0}, kFrame));
}

TEST(PlanePlaces, WithoutAHeadingBearingsStartFromTheBow) {
  PingNavigation unknown;
  unknown.transducer_depth_m = 5.0;
  EXPECT_EQ(plane_frame(unknown).heading_rad, 0.0);
  EXPECT_EQ(plane_frame(unknown).transducer_depth_m, 5.0);
}

}  // namespace
}  // namespace sonar
