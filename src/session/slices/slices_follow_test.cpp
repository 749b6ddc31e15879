// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slices_follow.h"

#include <gtest/gtest.h>

#include "session/slices/slice_places.h"
#include "session/test_app.h"

namespace sonar {
namespace {

/// Of fans and beams 5 to 7 and samples 200 to 205: half a sample is rounded up.
constexpr SlicePlaces kMiddle{6, 6, 203};

class Following : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(2, 4, 5, 5, 200);  // fans and beams 5 to 7
    document().settle();
    workspace().school.set(std::nullopt);
    workspace().slices.set({0, 0});
    document().look_at(3);
    document().settle();
  }
  void select() {
    workspace().school.set(SchoolName{document().shown()->index(), document().state().schools.front()->number});
    document().settle();
  }
};

TEST_F(Following, SlicesGoToTheMiddleOfWhatIsSelected) {
  select();
  EXPECT_EQ(workspace().slices(), kMiddle);
}

// Who clicks in a slice goes on looking at that slice.
TEST_F(Following, ASliceThatCutsTheSchoolStays) {
  workspace().slices.set({5, 20});
  select();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{5, 6, kMiddle.sample}));
}

TEST_F(Following, OfASchoolThatIsNotInThePingTheNearestIsShown) {
  document().look_at(0);
  document().settle();
  select();
  EXPECT_EQ(document().ping(), 2);
  EXPECT_EQ(workspace().slices(), kMiddle);
}

TEST_F(Following, PingsThatPlayAreFollowedAndThoseWithoutTheSchoolLeaveSlicesAlone) {
  select();
  workspace().slices.set({0, 6});
  document().look_at(5);
  document().settle();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{0, 6}));
  document().look_at(4);
  document().settle();
  EXPECT_EQ(workspace().slices(), kMiddle);
}

// A plane too goes to the school without turning, and stays where it cuts it.
TEST_F(Following, ThePlaneIsMovedUntilItCutsTheSchool) {
  const Sector& sector = document().shown()->sector();
  for (const PlaneSlice::Kind kind :
       {PlaneSlice::Kind::horizontal, PlaneSlice::Kind::vertical, PlaneSlice::Kind::oblique}) {
    workspace().school.set(std::nullopt);
    PlanePlace far_off = workspace().plane.values();
    far_off.lies = kind;
    far_off.depth_m = 1000.0;
    far_off.offset_m = -1000.0;
    far_off.bearing_deg = 77.0;
    workspace().plane.assign(far_off);
    select();
    EXPECT_EQ(workspace().plane.values().bearing_deg, 77.0);
    const auto plane = std::get<PlaneSlice>(live_slice(workspace(), SliceKind::plane, document().ping()));
    const Point<Sonar> off = sector.centre(kMiddle.fan, kMiddle.beam, kMiddle.sample) - plane.origin;
    // What is in the plane is the sum of its parts along the plane's axes.
    const double right = off.x * plane.right.x + off.y * plane.right.y + off.z * plane.right.z;
    const double down = off.x * plane.down.x + off.y * plane.down.y + off.z * plane.down.z;
    EXPECT_NEAR(right * right + down * down, norm(off) * norm(off), 1e-6);
  }
  PlanePlace near_by = workspace().plane.values();
  near_by.offset_m += 0.5;
  workspace().school.set(std::nullopt);
  workspace().plane.assign(near_by);
  select();
  EXPECT_EQ(workspace().plane.values(), near_by);
}

TEST_F(Following, LockedTheyStay) {
  const PlanePlace plane = workspace().plane.values();
  press("slices.lock");
  document().look_at(0);
  document().settle();
  select();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{0, 0}));
  EXPECT_EQ(workspace().plane.values(), plane);
  EXPECT_EQ(document().ping(), 0);
  press("slices.lock");
  document().look_at(3);
  document().settle();
  EXPECT_EQ(workspace().slices(), kMiddle);
}

}  // namespace
}  // namespace sonar
