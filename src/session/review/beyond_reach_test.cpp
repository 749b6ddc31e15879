// SPDX-License-Identifier: Apache-2.0
#include "session/review/beyond_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class BeyondReach : public TestApp, public testing::Test {
 protected:
  void SetUp() override {
    begin();
    found_ = longest_found();
    ASSERT_GE(found_.pings.size(), 6U);
  }

  /// Nobody looked for schools yet.
  void forget() {
    document().undo();
    document().settle();
    ASSERT_TRUE(document().state().schools.empty());
  }
  /// A click on the middle ping of the longest school that was found, followed so many pings to each side.
  void click(std::int64_t reach, std::optional<std::int64_t> forward = {}) {
    const auto& middle = found_.pings[found_.pings.size() / 2];
    const SchoolKey key = key_of(found_, document().shown()->context());
    PropagateCommand command;
    command.seeds = {{key.channel, key.sample}};
    command.reach = reach;
    command.reach_forward = forward;
    document().act(middle.ping_index, std::move(command));
    document().settle();
    select(document().state().schools.back()->number);
  }
  [[nodiscard]] const StateSchool& clicked() { return *document().state().schools.back(); }
  [[nodiscard]] bool offered() { return app_->actions.find(kContinueAction)->enabled(); }
  [[nodiscard]] std::int64_t counted() { return school_count(document().state(), document().product(0)); }

  SchoolMasks found_;
};

TEST_F(BeyondReach, IsSaidAtOnceAndOneActionGoesOn) {
  forget();
  EXPECT_FALSE(offered());
  click(1);
  EXPECT_THAT(document().notices().back(), HasSubstr("goes on beyond 1 ping: continue?"));
  EXPECT_TRUE(offered());
  EXPECT_EQ(ended_at_reach(clicked().masks), "both");
  const std::size_t lines = document().choices().lines->size();
  const std::int64_t number = clicked().number;
  press(std::string(kContinueAction));
  document().settle();
  // Both ends, by two lines of one step, as far as the panel's reach: 30 pings, more than there are.
  EXPECT_EQ(document().choices().lines->size(), lines + 2);
  EXPECT_EQ(clicked().number, number);
  EXPECT_EQ(ended_at_reach(clicked().masks), "");
  EXPECT_GT(clicked().masks.pings.size(), 3U);
  EXPECT_FALSE(offered());
  document().undo();
  document().settle();
  EXPECT_EQ(clicked().masks.pings.size(), 3U);
  EXPECT_EQ(ended_at_reach(clicked().masks), "both");
}

TEST_F(BeyondReach, ContinuedItMayHaveItsReachAgain) {
  forget();
  click(1);
  ASSERT_TRUE(workspace().select.set("reach_pings", 1));
  press(std::string(kContinueAction));
  document().settle();
  EXPECT_EQ(clicked().masks.pings.size(), 5U);
  EXPECT_EQ(ended_at_reach(clicked().masks), "both");
  EXPECT_THAT(document().notices().back(), HasSubstr("goes on beyond 1 ping: continue?"));
}

TEST_F(BeyondReach, NothingIsSaidOfASchoolThatEndsByItself) {
  forget();
  const std::size_t before = document().notices().size();
  click(-1);
  for (std::size_t i = before; i < document().notices().size(); ++i) {
    EXPECT_THAT(document().notices()[i], testing::Not(HasSubstr("goes on beyond")));
  }
  EXPECT_FALSE(offered());
}

// What detection found beyond the reach is the rest of it: there is nothing to go on with.
TEST_F(BeyondReach, NothingIsSaidWhereTheRestIsKnown) {
  const std::size_t before = document().notices().size();
  click(1);
  for (std::size_t i = before; i < document().notices().size(); ++i) {
    EXPECT_THAT(document().notices()[i], testing::Not(HasSubstr("goes on beyond")));
  }
  EXPECT_EQ(ended_at_reach(clicked().masks), "both");
  EXPECT_FALSE(offered());
}

TEST_F(BeyondReach, OneNumberIsNotSaidOfTwoReaches) {
  forget();
  click(1, 2);
  EXPECT_EQ(ended_at_reach(clicked().masks), "both");
  EXPECT_THAT(document().notices().back(), HasSubstr("goes on beyond its reach: continue?"));
}

TEST_F(BeyondReach, WindowCountsASchoolOfSeveralRowsOnce) {
  const std::int64_t found = counted();
  EXPECT_EQ(found, static_cast<std::int64_t>(document().state().schools.size()));
  click(1);
  EXPECT_EQ(document().state().schools.size(), static_cast<std::size_t>(found) + 1);
  EXPECT_EQ(counted(), found);
  // What the tables of the window tell is what a file of them would.
  EXPECT_EQ(school_count(*document().product(0)), found);
  const auto& rows = document().product(0)->schools;
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const SchoolRow& one) { return one.origin == "manual"; });
  ASSERT_NE(row, rows.end());
  EXPECT_EQ(row->ended_at_reach, "both");
  press("review.reject");
  document().settle();
  EXPECT_EQ(counted(), found) << "what detection found of it is not rejected";
}

}  // namespace
}  // namespace sonar
