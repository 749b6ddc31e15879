// SPDX-License-Identifier: Apache-2.0
#include "session/open/open_survey.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "session/open/document.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

class OneSurveyAfterAnother : public testing::Test {
 protected:
  void open_easy() { document_.open({TestSurvey::easy().folder()}); }

  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  Document document_{queue_, TestSurvey::options(journal_)};
};

// Acts, figures and schools that are still on their way are of the survey that was left.
TEST_F(OneSurveyAfterAnother, NothingOfASurveyReachesTheOneAfterIt) {
  open_easy();
  document_.settle();
  document_.detect({0});
  document_.settle();
  ASSERT_TRUE(document_.product(0));
  document_.look_at(4);
  document_.detect({0, 1});
  document_.act(EventCommand{"trawl", document_.shown()->context().times[2], "haul 1"});
  document_.keep_survey_numbers({SurveyNumber{}});
  document_.open({TestSurvey::easy().fresh()});
  document_.settle();
  ASSERT_NE(document_.survey(), nullptr);
  EXPECT_TRUE(document_.survey()->observations.empty());
  EXPECT_FALSE(document_.shown());
  EXPECT_FALSE(document_.staged());
  EXPECT_EQ(document_.ping(), 0);
  EXPECT_TRUE(document_.choices().states.empty());
  EXPECT_FALSE(document_.open_observation(0));
  EXPECT_FALSE(document_.product(0));
  EXPECT_FALSE(document_.detected(0));
  EXPECT_TRUE(document_.refused(0)->empty());
  EXPECT_TRUE(document_.survey_numbers().empty());
  EXPECT_FALSE(document_.busy());
  EXPECT_FALSE(document_.measuring());
  EXPECT_EQ(document_.activity().stage, "");
}

// A survey of a hundred observations must not be measured anew at each act.
TEST_F(OneSurveyAfterAnother, WhatIsDoneInOneObservationLeavesTheFiguresOfTheOthersAlone) {
  open_easy();
  document_.settle();
  document_.detect({1});
  document_.settle();
  const ProductPtr other = document_.product(1);
  const JournalStatePtr state = document_.choices().states.at(1);
  ASSERT_FALSE(state->schools.empty());
  document_.detect({0});
  document_.settle();
  ASSERT_FALSE(document_.state(0).schools.empty());
  document_.act(0, 0, DeleteCommand{key_of(document_.state(0).schools.front()->masks, document_.shown()->context())});
  document_.settle();
  EXPECT_EQ(document_.choices().states.at(1), state);
  EXPECT_EQ(document_.product(1), other);
  const std::size_t left = document_.state(0).schools.size();
  document_.undo();
  document_.settle();
  EXPECT_EQ(document_.state(0).schools.size(), left + 1);
  EXPECT_EQ(document_.product(1), other);
  document_.act(EventCommand{"trawl", document_.open_observation(1)->context().times[2], "haul 1"});
  document_.settle();
  EXPECT_NE(document_.choices().states.at(1), state) << "this is said of the other one";
}

TEST_F(OneSurveyAfterAnother, ARecipeThatIsChangedTwiceLeavesThePingThatWasLookedAt) {
  open_easy();
  document_.settle();
  ASSERT_TRUE(document_.show(1, 3));
  document_.settle();
  document_.use_recipe(document_.recipe());
  EXPECT_TRUE(document_.opening());
  document_.use_recipe(document_.recipe());
  document_.settle();
  EXPECT_FALSE(document_.opening());
  ASSERT_TRUE(document_.shown());
  EXPECT_EQ(document_.shown()->index(), 1U);
  EXPECT_EQ(document_.ping(), 3);
}

// Schools that the journal asks for are looked for when the first ping is there: not while another survey is being read.
TEST_F(OneSurveyAfterAnother, ASurveyThatIsBeingReadIsNotGivenUpForTheSchoolsOfTheOneBefore) {
  {
    Document before(queue_, TestSurvey::options(journal_));
    before.open({TestSurvey::easy().folder()});
    before.settle();
    before.detect({0});
    before.settle();
  }
  open_easy();
  while (!document_.shown()) {
    queue_.wait();
    queue_.drain();
  }
  std::atomic<bool> read_on{false};
  const std::filesystem::path other = TestSurvey::easy().fresh();
  document_.open({other}, [&](Work&) -> Result<void> {
    read_on.wait(false);
    return {};
  });
  while (!document_.staged()) {
    queue_.wait();
    queue_.drain();
  }
  read_on = true;
  read_on.notify_all();
  document_.settle();
  EXPECT_EQ(document_.paths(), std::vector{other});
}

// What is read but not yet taken is given up for what is asked for then: its job has ended and can no longer be cancelled.
TEST_F(OneSurveyAfterAnother, ASurveyThatWasReadIsNotTakenWhenSomethingElseWasAskedForSince) {
  open_easy();
  document_.settle();
  const std::vector<std::filesystem::path> easy = document_.paths();
  const std::filesystem::path other = TestSurvey::easy().fresh();
  const auto read_other = [&] {
    document_.open({other});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // an empty folder: it is read in no time
  };
  read_other();
  document_.detect({0});
  document_.settle();
  EXPECT_EQ(document_.paths(), easy);
  EXPECT_TRUE(document_.detected(0));
  read_other();
  open_easy();
  document_.settle();
  EXPECT_EQ(document_.paths(), easy);
  EXPECT_FALSE(document_.opening());
}

}  // namespace
}  // namespace sonar
