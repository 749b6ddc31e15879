// SPDX-License-Identifier: Apache-2.0
#include "session/looks/first_sight.h"

#include <gtest/gtest.h>

#include "session/test_app.h"

namespace sonar {
namespace {

class FirstSightOfASurvey : public testing::Test, protected TestApp {
 protected:
  /// Closes the window and opens the survey again.
  void open_again() {
    begin();
    document().settle();
  }
  /// A school in the second observation alone, in its ping 4.
  void paint_in_the_second() {
    ASSERT_TRUE(document().show(1, 2));
    document().settle();
    paint(4, 4, 5, 5, 200, 6, 30);
    document().settle();
  }
};

TEST_F(FirstSightOfASurvey, IsThePingOfTheStrongestWholeSchool) {
  begin();
  EXPECT_EQ(document().ping(), 0) << "where nobody has found a school";
  paint(1, 1, 2, 2, 300, 2);
  paint(3, 5, 5, 5, 200, 6, 30);
  document().settle();
  open_again();
  ASSERT_TRUE(workspace().school());
  EXPECT_EQ(workspace().school()->number, 2);
  EXPECT_GE(document().ping(), 3);
  EXPECT_LE(document().ping(), 5);
  const ProductPtr product = document().product(document().shown()->index());
  ASSERT_NE(product, nullptr);
  double here = 0.0;
  double most = 0.0;
  for (const SchoolPingRow& row : product->school_pings) {
    if (row.school_id != 2) continue;
    most = std::max(most, row.backscatter_m2);
    if (row.ping_index == document().ping()) here = row.backscatter_m2;
  }
  EXPECT_EQ(here, most);
}

TEST_F(FirstSightOfASurvey, IsInTheFirstObservationThatHasSchools) {
  begin();
  paint_in_the_second();
  open_again();  // another user, who was nowhere yet
  EXPECT_EQ(document().shown()->index(), 1U);
  EXPECT_EQ(document().ping(), 4);
  ASSERT_TRUE(workspace().school());
  EXPECT_EQ(*workspace().school(), (SchoolName{1, 1}));
}

TEST_F(FirstSightOfASurvey, IsNoOtherObservationThanTheOneThatItsUserLeft) {
  begin();
  paint_in_the_second();
  app_->preferences = {};
  app_->preferences.set_left_at({TestSurvey::easy().folder()}, "obs-0001", 0);
  document().open({TestSurvey::easy().folder()});
  document().settle();
  EXPECT_EQ(document().shown()->index(), 0U);
  EXPECT_EQ(document().ping(), 0);
}

TEST_F(FirstSightOfASurvey, WhatIsRejectedIsNone) {
  begin();
  paint(3, 3, 5, 5, 200);
  document().settle();
  workspace().school.set(SchoolName{document().shown()->index(), 1});
  press("review.reject");
  document().settle();
  open_again();
  EXPECT_EQ(document().ping(), 0);
  EXPECT_FALSE(workspace().school());
}

TEST_F(FirstSightOfASurvey, WhoHasGoneElsewhereStaysThere) {
  begin();
  document().look_at(7);
  document().settle();
  paint(3, 3, 5, 5, 200);
  document().settle();
  EXPECT_EQ(document().ping(), 7);
}

TEST_F(FirstSightOfASurvey, IsWhereItsUserLeftItBefore) {
  begin();
  ASSERT_TRUE(document().show(1, 7));
  document().settle();
  const Preferences kept = app_->preferences;
  begin();
  ASSERT_EQ(document().shown()->index(), 0U) << "another user's window";
  app_->preferences = kept;
  document().open({TestSurvey::easy().folder()});
  document().settle();
  EXPECT_EQ(document().shown()->index(), 1U);
  EXPECT_EQ(document().ping(), 7);
}

// Neighbours are made ahead: they are there at once, and nobody says that they are on their way.
TEST_F(FirstSightOfASurvey, IsTheNeighbourThatItsUserSteppedTo) {
  begin();
  ASSERT_TRUE(document().shown()->cache().held(1));
  document().look_at(1);
  document().settle();
  document().open({TestSurvey::easy().folder()});
  document().settle();
  EXPECT_EQ(document().ping(), 1);
}

TEST_F(FirstSightOfASurvey, IsTheFirstPingWhereTheObservationIsGone) {
  begin();
  app_->preferences.set_left_at({TestSurvey::easy().folder()}, "obs-0099", 7);
  document().open({TestSurvey::easy().folder()});
  document().settle();
  EXPECT_EQ(document().shown()->index(), 0U);
  EXPECT_EQ(document().ping(), 0);
}

}  // namespace
}  // namespace sonar
