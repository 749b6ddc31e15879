// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slices_follow.h"

#include <gtest/gtest.h>

#include "session/test_app.h"

namespace sonar {
namespace {

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
  EXPECT_EQ(workspace().slices(), (SlicePlaces{6, 6}));
}

// Who clicks in a slice goes on looking at that slice.
TEST_F(Following, ASliceThatCutsTheSchoolStays) {
  workspace().slices.set({5, 20});
  select();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{5, 6}));
}

TEST_F(Following, OfASchoolThatIsNotInThePingTheNearestIsShown) {
  document().look_at(0);
  document().settle();
  select();
  EXPECT_EQ(document().ping(), 2);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{6, 6}));
}

TEST_F(Following, PingsThatPlayAreFollowedAndThoseWithoutTheSchoolLeaveSlicesAlone) {
  select();
  workspace().slices.set({0, 6});
  document().look_at(5);
  document().settle();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{0, 6}));
  document().look_at(4);
  document().settle();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{6, 6}));
}

TEST_F(Following, LockedTheyStay) {
  press("slices.lock");
  document().look_at(0);
  document().settle();
  select();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{0, 0}));
  EXPECT_EQ(document().ping(), 0);
  press("slices.lock");
  document().look_at(3);
  document().settle();
  EXPECT_EQ(workspace().slices(), (SlicePlaces{6, 6}));
}

}  // namespace
}  // namespace sonar
