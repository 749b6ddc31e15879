// SPDX-License-Identifier: Apache-2.0
// Which surveys are taken, and where their results may go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/tasks/work_folders.h"
#include "session/batch/test_batch.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BatchFolders : public testing::Test, protected TestBatch {
 protected:
  /// The line with which something is refused; empty where it is not.
  static std::string refusal(const Result<void>& done) { return done ? std::string() : to_line(done.error()); }
};

TEST_F(BatchFolders, ResultsGoBesideTheSurvey) {
  ASSERT_TRUE(batch_.add({survey("one")}));
  EXPECT_EQ(out(0), root_ / "one-out");
  EXPECT_FALSE(fs::exists(out(0))) << "nothing is made before the start";
}

TEST_F(BatchFolders, AFolderOfSurveysStandsForEach) {
  const fs::path cruise = empty_folder("cruise");
  (void)survey("cruise/leg-2");
  (void)survey("cruise/leg-1");
  (void)empty_folder("cruise/photos");
  ASSERT_TRUE(batch_.add({cruise}));
  ASSERT_EQ(batch_.surveys().size(), 2U);
  EXPECT_EQ(batch_.surveys()[0].paths, std::vector{cruise / "leg-1"});
  EXPECT_EQ(batch_.surveys()[1].paths, std::vector{cruise / "leg-2"});
  EXPECT_EQ(out(1), cruise / "leg-2-out");
}

TEST_F(BatchFolders, FilesAreOneSurveyTogether) {
  const fs::path folder = survey("one");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  ASSERT_TRUE(batch_.add(files));
  ASSERT_EQ(batch_.surveys().size(), 1U);
  EXPECT_EQ(out(0), root_ / "one-out");
  ASSERT_TRUE(batch_.add({folder})) << "the folder may get more files";
  EXPECT_EQ(out(1), root_ / "one-out-2");
}

// An observation may go over from one folder into the other.
TEST_F(BatchFolders, WhatAWindowHasOpenTogetherIsOneSurvey) {
  const std::vector<fs::path> both{survey("one"), survey("two")};
  ASSERT_TRUE(batch_.add_survey(both));
  ASSERT_EQ(batch_.surveys().size(), 1U);
  EXPECT_EQ(batch_.surveys()[0].paths, both);
  EXPECT_FALSE(batch_.add_survey(both)) << "it is in the list already";
}

TEST_F(BatchFolders, ASurveyIsTakenOnceByWhateverName) {
  const fs::path one = survey("one");
  ASSERT_TRUE(batch_.add({one}));
  fs::create_directory_symlink(one, root_ / "link");
  for (const fs::path& again : {one, one / "", root_ / "." / "one", root_ / "link"}) {
    EXPECT_THAT(refusal(batch_.add({again})), HasSubstr("is in the list already")) << again;
  }
  EXPECT_EQ(batch_.surveys().size(), 1U);
  const fs::path two = survey("two");
  EXPECT_THAT(refusal(batch_.add({one, two})), HasSubstr("is in the list already"));
  EXPECT_EQ(batch_.surveys().size(), 2U) << "the other one is taken";
}

TEST_F(BatchFolders, NoTwoHaveOneFolderNorOneInTheOthers) {
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  const fs::path before = out(1);
  fs::create_directories(out(0));
  fs::create_directory_symlink(out(0), root_ / "link");
  for (const fs::path& folder : {out(0), out(0) / "deeper", root_ / "link", root_}) {
    const std::string line = refusal(batch_.set_out(1, folder));
    EXPECT_FALSE(line.empty()) << folder;
    EXPECT_EQ(line.find('\n'), line.npos);
  }
  EXPECT_THAT(refusal(batch_.set_out(1, out(0))), HasSubstr("results of " + (root_ / "one").string() + " go there"));
  EXPECT_EQ(out(1), before);
  ASSERT_TRUE(batch_.set_out(1, root_ / "elsewhere"));
  EXPECT_EQ(out(1), root_ / "elsewhere");
}

TEST_F(BatchFolders, NothingGoesWhereAnyRawFilesLie) {
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  const fs::path unlisted = survey("three");
  for (const fs::path& folder : {root_ / "one", root_ / "two", root_ / "two" / "out", unlisted / "out"}) {
    EXPECT_THAT(refusal(batch_.set_out(0, folder)), HasSubstr("raw files")) << folder;
  }
}

TEST_F(BatchFolders, ResultsOfOthersAreLeftAlone) {
  const fs::path one = survey("one");
  ASSERT_TRUE(run_easy(root_ / "one-out")) << "of another survey";
  ASSERT_TRUE(batch_.add({one}));
  EXPECT_EQ(out(0), root_ / "one-out-2");
  EXPECT_THAT(refusal(batch_.set_out(0, root_ / "one-out")), HasSubstr("holds results of another survey"));
  // What the window exported has human decisions in it, and no plan.
  fs::remove(root_ / "one-out" / "plan.json");
  EXPECT_THAT(refusal(batch_.set_out(0, root_ / "one-out")), HasSubstr("holds results of no run"));
  // So has what a run made of a session.
  Plan plan = *run_easy(root_ / "decided");
  plan.survey = {one.string()};
  plan.session = "/somewhere/session.jsonl";
  std::ofstream(root_ / "decided" / "plan.json") << plan_text(plan);
  EXPECT_THAT(refusal(batch_.set_out(0, root_ / "decided")), HasSubstr("decisions of /somewhere/session.jsonl"));
  plan.session.clear();
  std::ofstream(root_ / "decided" / "plan.json") << plan_text(plan);
  EXPECT_TRUE(batch_.set_out(0, root_ / "decided")) << "its own";
}

TEST_F(BatchFolders, WhatCameThereMeanwhileIsLeftAlone) {
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  ASSERT_TRUE(run_easy(out(0)));
  const auto before = bytes_in(out(0));
  run();
  EXPECT_EQ(state(0), BatchState::failed);
  EXPECT_THAT(batch_.surveys()[0].why, HasSubstr("holds results of another survey"));
  EXPECT_EQ(bytes_in(out(0)), before);
  EXPECT_EQ(state(1), BatchState::done);
}

TEST_F(BatchFolders, AFolderOfResultsStandsForItsSurveyAndGoesOn) {
  ASSERT_TRUE(batch_.add({survey("one")}));
  ASSERT_TRUE(batch_.set_out(0, root_ / "chosen"));
  run();
  Batch next(queue_, document_);
  ASSERT_TRUE(next.add({root_ / "chosen"}));
  ASSERT_EQ(next.surveys().size(), 1U);
  EXPECT_EQ(next.surveys()[0].paths, std::vector{root_ / "one"});
  EXPECT_EQ(next.surveys()[0].out, root_ / "chosen");
}

// A disk that an old Windows machine wrote has names that are no UTF-8.
TEST_F(BatchFolders, ASurveyWhoseNameIsNoUtf8GoesOnWhereItWasLeft) {
  ASSERT_TRUE(batch_.add({survey("st\xF8r")}));
  run();
  ASSERT_EQ(state(0), BatchState::done) << batch_.surveys()[0].why;
  const auto before = bytes_in(out(0));
  run();
  EXPECT_EQ(state(0), BatchState::done) << batch_.surveys()[0].why;
  EXPECT_EQ(bytes_in(out(0)), before) << "what is right stays";
  const auto named = told_apart(std::vector{out(0)});
  ASSERT_TRUE(named) << to_line(named.error());
  EXPECT_EQ(named->raw, std::vector{root_ / "st\xF8r"});
  const fs::path other = survey("st\xE6r");
  EXPECT_FALSE(require_results_of(out(0), std::vector{other})) << "told apart, though both look alike";
}

TEST_F(BatchFolders, TheListIsTakenUpAgain) {
  ASSERT_TRUE(batch_.add({survey("one"), survey("st\xF8r")}));
  ASSERT_TRUE(batch_.set_out(0, root_ / "chosen"));
  Preferences kept;
  kept.path = root_ / "preferences.json";
  kept.batch = batch_.listed();
  ASSERT_TRUE(kept.save());
  fs::rename(root_ / "one", root_ / "away");  // a disk that is not there now
  Batch next(queue_, document_);
  next.take_up(Preferences::load(kept.path).preferences.batch);
  EXPECT_EQ(next.listed(), batch_.listed());
  EXPECT_EQ(next.surveys().at(0).out, root_ / "chosen");
  next.settle();
}

TEST_F(BatchFolders, NothingBeginsWithoutWhatItNeeds) {
  EXPECT_THAT(refusal(batch_.start()), HasSubstr("no survey is in the list"));
  EXPECT_THAT(refusal(batch_.set_recipe(BatchRecipe::of_file, root_ / "no.json")), HasSubstr("no.json"));
  EXPECT_EQ(batch_.recipe_choice(), BatchRecipe::preset) << "what was chosen before stays";
  // Its results would lie beneath the raw files of the folder above it.
  const fs::path above = survey("above");
  ASSERT_TRUE(batch_.add({survey("above/below")}));
  EXPECT_TRUE(out(0).empty());
  EXPECT_THAT(refusal(batch_.start()), HasSubstr("has no folder for its results yet"));
  ASSERT_TRUE(batch_.set_out(0, root_ / "out"));
  Recipe recipe;
  ASSERT_TRUE(write_recipe((root_ / "R.json").string(), recipe));
  ASSERT_TRUE(batch_.set_recipe(BatchRecipe::of_file, root_ / "R.json"));
  fs::remove(root_ / "R.json");
  EXPECT_THAT(refusal(batch_.start()), HasSubstr("R.json"));
  EXPECT_FALSE(batch_.running());
}

}  // namespace
}  // namespace sonar
