// SPDX-License-Identifier: Apache-2.0
// The folder of a run's results is opened like the survey that it was made of.
#include "pipeline/tasks/work_folders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "pipeline/journal/session_recipe.h"
#include "pipeline/stages/detected_cache.h"
#include "session/pictures/exports.h"
#include "session/test_results.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class WorkFolders : public TestResults {
 protected:
  /// Takes the last school out of the second product, under the same key: whoever detects would find it.
  [[nodiscard]] std::size_t with_one_school_fewer() const {
    ObservationProduct product = product_of(1);
    const std::int64_t last = product.schools.back().school_id;
    product.schools.pop_back();
    std::erase_if(product.school_pings, [&](const SchoolPingRow& row) { return row.school_id == last; });
    std::erase_if(product.masks, [&](const SchoolMask& mask) { return mask.school_id == last; });
    keep_detected(product_path(out_, product.observation), product);
    EXPECT_EQ(product_of(1).schools.size(), product.schools.size());
    return product.schools.size();
  }
  [[nodiscard]] std::size_t schools(std::size_t observation) { return document().state(observation).schools.size(); }
};

TEST_F(WorkFolders, OpenTheirSurveyWithTheSchoolsOfTheRunAndNothingIsDetected) {
  const std::size_t left = with_one_school_fewer();
  open({out_});
  ASSERT_NE(document().survey(), nullptr);
  EXPECT_EQ(document().paths(), std::vector<fs::path>{raw_});
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_EQ(schools(0), 2U) << "as many as were simulated";
  EXPECT_EQ(schools(1), left) << "those of the file, not those that a detection would find";
  EXPECT_THAT(document().notices(), Each(Not(HasSubstr("Ctrl+D"))));
  ASSERT_TRUE(document().product(0));
  EXPECT_EQ(document().product(0)->schools.at(0).backscatter_m2, product_of(0).schools.at(0).backscatter_m2);
}

TEST_F(WorkFolders, WhatWasTakenFromThemIsThereWhenTheSurveyIsOpenedNext) {
  cache_.folder = TestSurvey::easy().fresh();
  const std::size_t left = with_one_school_fewer();
  open({out_});
  EXPECT_EQ(app_->actions.find("file.recent.1")->text_now(), out_.string());
  open({raw_});
  EXPECT_EQ(schools(1), left);
}

TEST_F(WorkFolders, OpenUnderTheRecipeOfTheRunWhichIsKeptBesideTheJournal) {
  Recipe recipe;
  recipe.detect.tolerance_db = 7.0;
  ASSERT_TRUE(run_easy(out_, recipe));
  open({out_});
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0);
  EXPECT_FALSE(document().recipe().automatic);
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_THAT(document().notices(), Contains(AllOf(HasSubstr("recipe"), HasSubstr(out_.string()))));
  const auto kept = kept_recipe(std::vector<fs::path>{journal_});
  ASSERT_TRUE(kept && *kept);
  EXPECT_EQ((*kept)->detect.tolerance_db, 7.0);
  open({out_});
  EXPECT_THAT(document().notices(), Each(Not(HasSubstr("recipe")))) << "it is told once";
}

TEST_F(WorkFolders, OfAnotherVersionAreShownAsTheyAreAndALineSaysWhoMadeThem) {
  cache_.folder = TestSurvey::easy().fresh();
  const std::size_t left = with_one_school_fewer();
  const auto says_who = Contains(
      AllOf(HasSubstr(out_.string()), HasSubstr("2 observations"), HasSubstr("version test"), HasSubstr("Ctrl+D")));
  open({out_}, "another");
  ASSERT_TRUE(document().staged()) << "with pings";
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_EQ(schools(0), 2U);
  EXPECT_EQ(schools(1), left) << "those of the file, not those that a detection would find";
  EXPECT_THAT(document().notices(), says_who);
  ASSERT_TRUE(document().product(0));
  const ObservationProduct was = product_of(0);
  EXPECT_EQ(document().product(0)->program_version, "test");
  EXPECT_EQ(document().product(0)->input_hash, "") << "it is no find of this version";
  EXPECT_EQ(document().product(0)->school_pings.size(), was.school_pings.size());
  EXPECT_EQ(document().product(0)->schools.at(0).backscatter_m2, was.schools.at(0).backscatter_m2);
  press("schools.detect_all");
  document().settle();
  EXPECT_GT(schools(1), left) << "what is found now";
  EXPECT_EQ(document().product(0)->program_version, "another");
  EXPECT_EQ(product_of(1).schools.size(), left) << "the results are not written over";
  open({out_}, "another");
  EXPECT_GT(schools(1), left) << "the own find goes before";
  EXPECT_THAT(document().notices(), Not(says_who));
}

// Masks of the other version lie a little farther out: a decision upon one holds when schools are found anew, and what a
// human changes is measured by the version that is there.
TEST_F(WorkFolders, OfAnotherVersionAreDecidedUponAndChanged) {
  constexpr int kFarther = 3;
  cache_.folder = TestSurvey::easy().fresh();
  ObservationProduct made = product_of(0);
  for (SchoolMask& mask : made.masks) {
    for (sonar::Run& run : mask.mask.runs) run.first_sample += kFarther;
  }
  keep_detected(product_path(out_, made.observation), made);
  open({out_}, "another");
  ASSERT_TRUE(document().as_made(0));
  EXPECT_EQ(document().product(0)->masks.front().mask, made.masks.front().mask);
  Decision decision;
  decision.species = "herring";
  decide_on(workspace(), {survey_schools(document()).front()}, decision);
  document().settle();
  EXPECT_EQ(document().product(0)->schools.front().species, "herring");
  EXPECT_EQ(document().product(0)->program_version, "test") << "a decision moves no mask";
  paint(2, 4, 5, 5, 200);
  document().settle();
  EXPECT_EQ(document().product(0)->program_version, "another") << "figures of two versions stand in no table";
  EXPECT_THAT(document().product(0)->school_pings, testing::SizeIs(testing::Gt(made.school_pings.size())));
  const fs::path written = TestSurvey::easy().fresh() / "written";
  export_results(workspace(), written);
  document().settle();
  EXPECT_TRUE(kept_detected(product_path(written, made.observation), "")) << "under no key of a find";
  press("schools.detect_all");
  document().settle();
  EXPECT_EQ(document().as_made(0), nullptr);
  const auto is_herring = [](const auto& school) { return school->masks.decided.species == "herring"; };
  EXPECT_EQ(std::ranges::count_if(document().state(0).schools, is_herring), 1);
}

// What was found in other pings, or under a recipe that was not asked for, says nothing of these.
TEST_F(WorkFolders, OfAnotherVersionAndOtherPingsAreNotShown) {
  ObservationProduct other = product_of(0);
  for (PingNavigation& ping : other.pings) ping.time += kSecondNs;
  keep_detected(product_path(out_, other.observation), other);
  open({out_}, "another");
  EXPECT_FALSE(document().detected(0));
  EXPECT_TRUE(document().detected(1));
  EXPECT_THAT(document().notices(), Contains(HasSubstr("the schools of 1 observation are not those of this version")));
  EXPECT_THAT(document().notices(), Contains(HasSubstr("the schools of 1 observation are shown as version test")));
  Recipe recipe;
  recipe.detect.tolerance_db = 7.0;
  document().open({out_});
  document().use_recipe(recipe);  // of what is being opened
  document().settle();
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0);
  EXPECT_EQ(document().as_made(1), nullptr);
}

TEST_F(WorkFolders, BesideTheirRawFilesGiveTheirSchoolsWhereverThoseLieNow) {
  move_raw_away();
  open({out_, raw_});
  EXPECT_EQ(document().paths(), std::vector<fs::path>{raw_});
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_EQ(schools(0), 2U);
}

TEST_F(WorkFolders, WithoutAPlanTakeTheRecipeOfTheirProducts) {
  fs::remove(out_ / "plan.json");
  const std::vector<fs::path> both{raw_, out_};
  const auto named = told_apart(both);
  ASSERT_TRUE(named);
  EXPECT_EQ(named->work_folders, std::vector<fs::path>{out_});
  ASSERT_TRUE(named->recipe) << "that of the products";
  EXPECT_EQ(recipe_hash(*named->recipe), recipe_hash(Recipe{}));
}

TEST_F(WorkFolders, OfANewerProgramAreRefusedInOneLine) {
  std::ofstream(out_ / "plan.json") << R"({"plan_version": 999})";
  open({out_});
  EXPECT_EQ(document().survey(), nullptr);
  ASSERT_EQ(document().notices().size(), 1U);
  EXPECT_THAT(document().notices().front(), HasSubstr("plan.json"));
}

TEST_F(WorkFolders, AFolderOfRawFilesWithProductsOfItsOwnIsASurvey) {
  const fs::path survey = TestSurvey::easy().fresh();
  fs::create_directories(survey / "products");
  std::ofstream(survey / "a.raw") << "x";
  const std::vector<fs::path> paths{survey};
  const auto named = told_apart(paths);
  ASSERT_TRUE(named);
  EXPECT_EQ(named->raw, paths);
  EXPECT_TRUE(named->work_folders.empty());
}

}  // namespace
}  // namespace sonar
