// SPDX-License-Identifier: Apache-2.0
#include "session/review/review.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class ReviewAtWork : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  /// Small schools all over two pings, none touching another.
  void paint_schools(int count) {
    for (int i = 0; i < count; ++i)
      paint(i % 2, i % 2, 2 + 4 * (i / 2 % 5), 1 + 3 * (i / 10 % 6), 150 + 20 * (i / 60), 2);
    document().settle();
    ASSERT_EQ(document().state().schools.size(), static_cast<std::size_t>(count));
  }
  /// One over five pings, one over two.
  void paint_long_and_short() {
    paint(2, 6, 5, 5, 200);
    paint(2, 3, 12, 12, 300);
    document().settle();
  }
  /// A school in each observation; the second one, over pings first .. last, is shown.
  void paint_in_each_observation(std::int64_t first, std::int64_t last) {
    paint(2, 3, 5, 5, 200);
    document().settle();
    ASSERT_TRUE(document().show(1));
    document().settle();
    paint(first, last, 5, 5, 200);
    document().settle();
  }
  [[nodiscard]] Review& review() { return dynamic_cast<Review&>(*app_->rows("review")); }
  [[nodiscard]] std::size_t backscatter_column() {
    const auto& columns = review().columns();
    return static_cast<std::size_t>(
        std::find_if(columns.begin(), columns.end(), [](const auto& c) { return c.title == "Backscatter"; }) -
        columns.begin());
  }
  [[nodiscard]] int with_status(const std::string& status) {
    int count = 0;
    for (const SurveySchool& school : survey_schools(document())) count += school.decided().status == status ? 1 : 0;
    return count;
  }
};

TEST_F(ReviewAtWork, AFreshUserReviewsAHundredSchoolsWithTwoKeysEachAtMost) {
  paint_schools(100);
  press("review.next");
  for (int i = 0; i < 100; ++i) {
    // Faster than the program carries it out: nothing is drained between the keys.
    press("review.species." + std::to_string(1 + i % 3));
    press(i % 4 == 3 ? "review.reject" : "review.accept");
  }
  document().settle();
  EXPECT_EQ(with_status("accepted"), 75);
  EXPECT_EQ(with_status("rejected"), 25);
  for (const auto& school : document().state().schools) EXPECT_FALSE(school->masks.decided.species.empty());
  EXPECT_EQ(review().unreviewed(), 0U);
  press("review.next");
  EXPECT_EQ(document().notices().back(), "every school is reviewed");
}

TEST_F(ReviewAtWork, WhatCannotBeWrittenDownIsShownAgainInsteadOfTheNext) {
  paint_schools(3);
  begin();  // a new run, which has written nothing yet
  press("review.next");
  document().settle();
  const auto school = workspace().school();
  ASSERT_TRUE(school);
  ChangeQueue queue;
  Document other_window(queue, TestSurvey::options(document().journal_path().parent_path()));
  other_window.open({TestSurvey::easy().folder()});
  other_window.settle();
  ASSERT_TRUE(other_window.show(school->observation));
  other_window.act(EventCommand{"trawl", other_window.shown()->context().times[2], ""});
  other_window.settle();
  press("review.reject");
  EXPECT_NE(workspace().school(), school) << "it goes on at once";
  document().settle();
  EXPECT_EQ(workspace().school(), school);
  EXPECT_EQ(with_status("rejected"), 0);
  EXPECT_THAT(document().notices().back(), HasSubstr("is at work on obs-000"));
}

// Detection brings weak and strong schools alike; before all are measured nobody knows which is the strongest.
TEST_F(ReviewAtWork, WhileSchoolsAreMeasuredTheNextOneWaitsForTheStrongest) {
  document().detect({0, 1});
  bool asked = false;
  const Listening heard_of(document().changes(), [&](DocumentChange change) {
    if (change != DocumentChange::state || asked || document().state().schools.empty()) return;
    asked = true;
    EXPECT_TRUE(document().product(0) == nullptr || document().product(0)->schools.empty())
        << "nothing is measured yet";
    press("review.next");
    EXPECT_FALSE(workspace().school());
    EXPECT_THAT(document().notices().back(), HasSubstr("measuring"));
  });
  document().settle();
  ASSERT_TRUE(asked);
  ASSERT_TRUE(workspace().school()) << "it goes there by itself";
  EXPECT_THAT(document().notices().back(), testing::Not(HasSubstr("when all are measured"))) << "it waits no longer";
  EXPECT_EQ(review().selected(), 0U);
  const double most_m2 = std::get<double>(review().cell(0, backscatter_column()).key);
  for (std::size_t row = 1; row < review().rows(); ++row) {
    EXPECT_LE(std::get<double>(review().cell(row, backscatter_column()).key), most_m2);
  }
}

TEST_F(ReviewAtWork, TheStrongestThatIsNotReviewedComesFirst) {
  paint_schools(6);
  workspace().school.set(std::nullopt);
  double last_m2 = INFINITY;
  for (std::size_t row = 0; row < review().rows(); ++row) {
    const double m2 = std::get<double>(review().cell(row, backscatter_column()).key);
    EXPECT_LE(m2, last_m2);
    last_m2 = m2;
  }
  press("review.next");
  const auto first = workspace().school();
  EXPECT_EQ(review().selected(), 0U);
  press("review.accept");
  document().settle();
  EXPECT_NE(workspace().school(), first);
  // It has gone to the end.
  workspace().school.set(first);
  EXPECT_EQ(review().selected(), 5U);
}

TEST_F(ReviewAtWork, NextGoesOnlyToWhatTheFilterLeaves) {
  paint_schools(6);
  review().narrow("school=4");
  press("review.next");
  EXPECT_EQ(workspace().school(), (SchoolName{0, 4}));
}

TEST_F(ReviewAtWork, WithoutAdvanceTheSchoolStays) {
  paint_schools(3);
  press("review.next");
  const auto first = workspace().school();
  press("review.advance");
  press("review.reject");
  document().settle();
  EXPECT_EQ(workspace().school(), first);
}

TEST_F(ReviewAtWork, TheDigitsMeanWhatTheUserSays) {
  paint_schools(1);
  press("review.next");
  app_->dialogs.text = [](const auto&, const auto&, const std::string& now) {
    EXPECT_TRUE(now.starts_with("herring, mackerel, "));
    return std::optional<std::string>(" lodde ,  snow crab,,torsk ");
  };
  press("review.species_names");
  EXPECT_EQ(app_->preferences.species, (std::vector<std::string>{"lodde", "snow crab", "torsk"}));
  press("review.species.2");
  document().settle();
  EXPECT_EQ(survey_schools(document()).front().decided().species, "snow crab");
  app_->dialogs.text = [](const auto&, const auto&, const auto&) { return std::optional<std::string>(" , "); };
  press("review.species_names");
  EXPECT_EQ(app_->preferences.species.size(), 3U);
}

TEST_F(ReviewAtWork, ARuleDecidesAllInOneStepThatCanBeUndone) {
  paint_long_and_short();
  const std::size_t lines = document().choices().lines->size();
  app_->dialogs.text = [](const auto&, const std::string& label, const std::string& rule) {
    EXPECT_THAT(label, HasSubstr("depth and length in m"));
    EXPECT_EQ(rule, kDefaultBulkRule);
    return std::string("pings >= 5 -> accept");
  };
  press("review.rule");
  document().settle();
  EXPECT_EQ(document().choices().lines->size(), lines + 1);
  EXPECT_EQ(last_line().command, "bulk_decide");
  EXPECT_EQ((*last_line().args)["rule"], "pings >= 5 -> accept");
  EXPECT_EQ(with_status("accepted"), 1);
  EXPECT_EQ(with_status("unreviewed"), 1);
  press("edit.undo");
  document().settle();
  EXPECT_EQ(with_status("accepted"), 0);
}

TEST_F(ReviewAtWork, ARuleTakesWhatTheFilterOfItsListTakes) {
  paint_long_and_short();
  WindowParams window = workspace().window.values();
  window.units.lengths = LengthUnit::feet;
  workspace().window.assign(window);
  document().settle();
  const auto least =
      std::ranges::min(survey_schools(document()), {}, [](const SurveySchool& s) { return s.row->depth_m; });
  const auto most =
      std::ranges::max(survey_schools(document()), {}, [](const SurveySchool& s) { return s.row->depth_m; });
  const std::string limit = fmt::format("depth>{:.3f}", 0.5 * (least.row->depth_m + most.row->depth_m) / 0.3048);
  int left = 0;
  for (std::size_t row = 0; row < review().rows(); ++row) left += row_matches(review(), row, limit) ? 1 : 0;
  ASSERT_EQ(left, 1);
  ASSERT_TRUE(review().decide_all(limit + " -> reject"));
  document().settle();
  EXPECT_EQ(with_status("rejected"), left);
}

TEST_F(ReviewAtWork, ARuleReachesAllObservationsAtOnce) {
  paint_in_each_observation(2, 4);
  ASSERT_TRUE(review().decide_all("pings > 1 -> reject"));
  document().settle();
  EXPECT_EQ(with_status("rejected"), 2);
  document().undo();
  document().settle();
  EXPECT_EQ(with_status("rejected"), 0);
  EXPECT_FALSE(review().decide_all("pings > 100 -> reject"));
}

TEST_F(ReviewAtWork, SeveralSelectedSchoolsAreDecidedInOneStep) {
  paint_schools(6);
  app_->preferences.advance = false;
  const std::size_t lines = document().choices().lines->size();
  review().select(4);
  review().choose({0, 2, 4});
  EXPECT_EQ(app_->actions.find("review.accept")->text_now(), "Accept (3 schools)");
  press("review.accept");
  document().settle();
  EXPECT_EQ(document().choices().lines->size(), lines + 1);
  EXPECT_EQ(last_line().command, "bulk_decide");
  EXPECT_EQ(document().choices().undo_text, "Undo accept 3 schools");
  EXPECT_EQ(with_status("accepted"), 3);
  EXPECT_EQ(document().notices().back(), "3 schools accepted; 3 of 6 left to review");
  // They have gone to the end, and are what is selected still.
  EXPECT_EQ(review().chosen(), (std::vector<std::size_t>{3, 4, 5}));
  press("review.species.2");
  document().settle();
  EXPECT_EQ(document().choices().undo_text, "Undo set species of 3 schools");
  press("edit.undo");
  press("edit.undo");
  document().settle();
  EXPECT_EQ(with_status("accepted"), 0);
  begin();  // the journal says the same
  press("edit.redo");
  document().settle();
  EXPECT_EQ(with_status("accepted"), 3);
}

TEST_F(ReviewAtWork, AfterSeveralTheNextThatIsNotReviewedIsShown) {
  paint_schools(4);
  review().select(0);
  const auto first = workspace().school();
  review().choose({0, 1, 2});
  press("review.reject");
  EXPECT_NE(workspace().school(), first);
  EXPECT_TRUE(workspace().chosen_schools().empty()) << "the next one alone";
  document().settle();
  EXPECT_EQ(with_status("rejected"), 3);
  EXPECT_EQ(review().unreviewed(), 1U);
  EXPECT_EQ(survey_schools(document())[static_cast<std::size_t>(workspace().school()->number - 1)].decided().status,
            "unreviewed");
}

TEST_F(ReviewAtWork, AnotherSchoolEndsTheChoiceOfSeveral) {
  paint_schools(4);
  app_->preferences.advance = false;
  review().select(0);
  review().choose({0, 1});
  const std::set<SchoolName> chosen = workspace().chosen_schools();
  ASSERT_EQ(chosen.size(), 2U);
  workspace().school.set(*chosen.rbegin());
  EXPECT_EQ(workspace().chosen_schools(), chosen) << "one of them may be looked at";
  review().select(3);
  EXPECT_TRUE(workspace().chosen_schools().empty());
  press("review.accept");
  document().settle();
  EXPECT_EQ(last_line().command, "decide");
  // One that is deleted is none of them any more, and one alone is not several.
  review().select(0);
  review().choose({0, 1});
  press("school.delete");
  document().settle();
  EXPECT_TRUE(workspace().chosen_schools().empty());
  EXPECT_EQ(with_status("accepted"), 1);
}

TEST_F(ReviewAtWork, ACommentIsOfAllThatAreSelectedInWhicheverObservation) {
  paint_in_each_observation(2, 4);
  review().select(0);
  review().choose({0, 1});
  app_->dialogs.text = [](const std::string& title, const auto&, const std::string& now) {
    EXPECT_EQ(title, "2 schools");
    EXPECT_EQ(now, "");
    return std::string("near the wreck");
  };
  press("school.comment");
  document().settle();
  EXPECT_EQ(document().choices().undo_text, "Undo comment on 2 schools");
  for (const SurveySchool& school : survey_schools(document())) EXPECT_EQ(school.decided().comment, "near the wreck");
}

TEST_F(ReviewAtWork, EachDecisionTellsHowManyAreLeft) {
  EXPECT_EQ(review().note(), "");
  paint_schools(3);
  EXPECT_EQ(review().note(), "3 of 3 left");
  press("review.next");
  const SchoolName first = *workspace().school();
  press("review.accept");
  document().settle();
  EXPECT_EQ(document().notices().back(), fmt::format("school {} accepted; 2 of 3 left to review", first.number));
  EXPECT_EQ(review().note(), "2 of 3 left");
  const std::size_t told = document().notices().size();
  press("review.species.1");
  document().settle();
  EXPECT_EQ(document().notices().size(), told) << "a species decides nothing";
  app_->preferences.advance = false;
  workspace().school.set(first);
  press("review.unreview");
  document().settle();
  EXPECT_EQ(document().notices().back(), fmt::format("school {} not reviewed; 3 of 3 left to review", first.number));
  press("review.next");
  press("review.next");
  press("review.next");
  EXPECT_EQ(workspace().school(), first) << "it waits for a review again";
}

TEST_F(ReviewAtWork, UndoOfADecisionBringsItsSchoolBackIntoSight) {
  paint_in_each_observation(8, 9);
  press("review.next");
  const SchoolName first = *workspace().school();
  press("review.reject");
  document().settle();
  ASSERT_NE(document().shown()->index(), first.observation) << "it goes on to the other observation";
  press("edit.undo");
  document().settle();
  EXPECT_EQ(workspace().school(), first);
  EXPECT_EQ(document().shown()->index(), first.observation);
  EXPECT_NE(in_ping(selected_school(workspace())->state->masks, document().ping()), nullptr);
  EXPECT_EQ(document().notices().back(),
            fmt::format("taken back: reject school {}; 2 of 2 left to review", first.number));
  // Redo, and an undo of anything else, leave the view where it is.
  ASSERT_TRUE(document().show(1 - first.observation));
  press("edit.redo");
  document().settle();
  EXPECT_NE(document().shown()->index(), first.observation);
}

TEST_F(ReviewAtWork, UndoLeavesWhoeverLooksAtItsSchoolWhereTheyAre) {
  paint(2, 6, 5, 5, 200);
  document().settle();
  app_->preferences.advance = false;
  select(1);
  document().look_at(5);
  press("review.accept");
  document().settle();
  press("edit.undo");
  document().settle();
  EXPECT_EQ(with_status("unreviewed"), 1);
  EXPECT_EQ(document().ping(), 5);
}

TEST_F(ReviewAtWork, UndoOfARuleShowsTheFirstOfItsSchools) {
  paint_schools(3);
  ASSERT_TRUE(review().decide_all("pings > 0 -> accept"));
  document().settle();
  EXPECT_EQ(document().choices().undo_text, "Undo accept 3 schools");
  EXPECT_EQ(document().notices().back(), "3 schools accepted; 0 of 3 left to review");
  workspace().school.set(std::nullopt);
  press("edit.undo");
  document().settle();
  EXPECT_TRUE(workspace().school());
  EXPECT_EQ(document().notices().back(), "taken back: accept 3 schools; 3 of 3 left to review");
}

}  // namespace
}  // namespace sonar
