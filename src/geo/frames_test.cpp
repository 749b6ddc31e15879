// SPDX-License-Identifier: Apache-2.0
#include "geo/frames.h"

#include <gtest/gtest.h>

#include <concepts>
#include <numbers>

#include "geo/geodesic.h"

namespace sonar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

template <class A, class B>
concept Addable = requires(A a, B b) { a + b; };
template <class A, class B>
concept Subtractable = requires(A a, B b) { a - b; };
template <class A, class B>
concept Comparable = requires(A a, B b) { a == b; };
template <class P>
concept TurnsToEnu = requires(P p) { to_enu(p, 0.0); };
template <class P>
concept HasPlace = requires(P p, Geographic g) { to_geographic(p, g); };

// What a careless hand would write does not compile.
static_assert(Addable<Point<Enu>, Point<Enu>> && !Addable<Point<Enu>, Point<Sonar>>);
static_assert(!Addable<Point<Vessel>, Point<Sonar>> && !Subtractable<Point<Sonar>, Point<Enu>>);
static_assert(Comparable<Point<Sonar>, Point<Sonar>> && !Comparable<Point<Sonar>, Point<Vessel>>);
static_assert(!std::convertible_to<Point<Vessel>, Point<Sonar>> && !std::constructible_from<Point<Enu>, Point<Sonar>>);
static_assert(!std::assignable_from<Point<Enu>&, Point<Sonar>>);
static_assert(TurnsToEnu<Point<Sonar>> && !TurnsToEnu<Point<Vessel>> && !TurnsToEnu<Point<Enu>>);
static_assert(HasPlace<Point<Enu>> && !HasPlace<Point<Sonar>> && !HasPlace<Point<Vessel>>);

// By hand: heading 90 (east) puts the bow east, starboard south and down below.
TEST(Frames, HeadingEast) {
  const Point<Enu> bow = to_enu(Point<Sonar>{10, 0, 0}, 90 * kDegree);
  EXPECT_NEAR(bow.x, 10, 1e-12);
  EXPECT_NEAR(bow.y, 0, 1e-12);
  const Point<Enu> starboard = to_enu(Point<Sonar>{0, 10, 3}, 90 * kDegree);
  EXPECT_NEAR(starboard.x, 0, 1e-12);
  EXPECT_NEAR(starboard.y, -10, 1e-12);
  EXPECT_EQ(starboard.z, -3);
}

TEST(Frames, ToSonarInvertsToEnu) {
  const Point<Sonar> p{3, -4, 12};
  for (const double heading : {0.0, 0.7, 2.5, 4.0, 6.0}) {
    const Point<Sonar> back = to_sonar(to_enu(p, heading), heading);
    EXPECT_NEAR(back.x, p.x, 1e-12);
    EXPECT_NEAR(back.y, p.y, 1e-12);
    EXPECT_NEAR(back.z, p.z, 1e-12);
  }
}

// By hand. Roll positive port up: what is to starboard goes down. Pitch positive bow up: the bow's z goes negative
// (up).
TEST(Frames, LevelFollowsTheSignsOfTheMotionSensor) {
  const Point<Sonar> starboard = level({0, 10, 0}, 30 * kDegree, 0);
  EXPECT_NEAR(starboard.y, 10 * std::sqrt(3.0) / 2, 1e-12);
  EXPECT_NEAR(starboard.z, 5, 1e-12);
  const Point<Sonar> bow = level({10, 0, 0}, 0, 30 * kDegree);
  EXPECT_NEAR(bow.x, 10 * std::sqrt(3.0) / 2, 1e-12);
  EXPECT_NEAR(bow.z, -5, 1e-12);
  EXPECT_NEAR(norm(level({3, -4, 12}, 0.2, -0.1)), 13.0, 1e-12);
}

TEST(Frames, Wrapping) {
  EXPECT_EQ(wrap_360(-90), 270);
  EXPECT_EQ(wrap_360(360), 0);
  EXPECT_EQ(wrap_360(725), 5);
  EXPECT_EQ(wrap_360(-1e-20), 0);
  EXPECT_EQ(wrap_180(180), -180);
  EXPECT_EQ(wrap_180(-180), -180);
  EXPECT_EQ(wrap_180(190), -170);
}

}  // namespace
}  // namespace sonar
