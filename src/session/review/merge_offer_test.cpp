// SPDX-License-Identifier: Apache-2.0
#include "session/review/merge_offer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// One school of the survey, clicked twice: three of its pings each time.
class MergeOffered : public TestApp, public testing::Test {
 protected:
  void SetUp() override {
    begin();
    found_ = longest_found();
    ASSERT_GE(found_.pings.size(), 6U);
    document().undo();
    document().settle();
    click(1);
    ASSERT_FALSE(offer().standing());
    click(4);
    ASSERT_EQ(document().state().schools.size(), 2U);
  }
  void click(std::size_t at) {
    SchoolMasks there;
    there.pings = {found_.pings[at]};
    const SchoolKey key = key_of(there, document().shown()->context());
    PropagateCommand command;
    command.seeds = {{key.channel, key.sample}};
    command.reach = 1;
    document().act(there.pings[0].ping_index, std::move(command));
    document().settle();
  }
  MergeOffer& offer() { return *app_->merge_offer; }
  bool enabled() { return app_->actions.find(kMergeProposedAction)->enabled(); }

  SchoolMasks found_;
};

TEST_F(MergeOffered, WhereOneGoesOnWhereTheOtherEndsOneKeyMergesThemAndUndoPartsThem) {
  ASSERT_TRUE(offer().standing());
  EXPECT_EQ(*offer().standing(), (MergeProposal{1, 2, found_.pings[2].ping_index, found_.pings[3].ping_index}));
  EXPECT_THAT(document().notices(), Contains(HasSubstr("school 2 begins in ping")));
  EXPECT_EQ(offer().text(), "Merge school 1 and school 2");
  EXPECT_TRUE(enabled());
  press(std::string(kMergeProposedAction));
  document().settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(document().state().schools[0]->masks.pings.size(), 6U);
  EXPECT_EQ(last_line().command, "merge");
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_FALSE(enabled());
  press("edit.undo");
  document().settle();
  EXPECT_EQ(document().state().schools.size(), 2U);
  EXPECT_TRUE(enabled()) << "they may still be one";
}

TEST_F(MergeOffered, DeclinedItIsNotOfferedAgain) {
  const std::size_t lines = document().choices().lines->size();
  press("school.keep_apart");
  document().settle();
  EXPECT_FALSE(enabled());
  EXPECT_EQ(document().choices().lines->size(), lines) << "nothing is done to the schools";
  press(std::string(kMergeProposedAction));
  document().settle();
  EXPECT_EQ(document().state().schools.size(), 2U);
}

TEST_F(MergeOffered, ARejectedSchoolIsNot) {
  select(2);
  press("review.reject");
  document().settle();
  EXPECT_FALSE(enabled());
  press("edit.undo");
  document().settle();
  EXPECT_TRUE(enabled());
}

TEST_F(MergeOffered, WhatAHumanSplitIsNotOffered) {
  press(std::string(kMergeProposedAction));
  document().settle();
  document().look_at(found_.pings[2].ping_index);
  document().settle();
  press("school.split");
  document().settle();
  ASSERT_EQ(document().state().schools.size(), 2U);
  EXPECT_FALSE(enabled());
  press("school.propagate_forwards");  // and its parts may be carried on
  document().settle();
  EXPECT_FALSE(enabled());
}

}  // namespace
}  // namespace sonar
