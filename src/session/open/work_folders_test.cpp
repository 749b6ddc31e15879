// SPDX-License-Identifier: Apache-2.0
// The folder of a run's results is opened like the survey that it was made of.
#include "pipeline/tasks/work_folders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "pipeline/journal/session_recipe.h"
#include "pipeline/stages/detected_cache.h"
#include "session/test_app.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class WorkFolders : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    auto plan = run_easy(out_);
    ASSERT_TRUE(plan) << to_line(plan.error());
    plan_ = *plan;
  }
  void open(std::vector<fs::path> paths, const std::string& version = "test") {
    DocumentOptions options = TestSurvey::options(journal_);
    options.program_version = version;
    options.cache = cache_;
    app_ = std::make_unique<AppModel>(queue_, options);
    document().open(std::move(paths));
    document().settle();
  }
  /// What the run made of the observation of a task.
  [[nodiscard]] ObservationProduct product_of(std::size_t task) const {
    auto product = kept_detected(product_path(out_, plan_.tasks[task].observation), plan_.tasks[task].key);
    EXPECT_TRUE(product);
    return product.value_or(ObservationProduct{});
  }
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
  /// The plan names raw files that are not there.
  void move_raw_away() {
    plan_.survey = {(out_ / "gone").string()};
    std::ofstream(out_ / "plan.json") << plan_text(plan_);
  }
  [[nodiscard]] std::size_t schools(std::size_t observation) { return document().state(observation).schools.size(); }

  const fs::path& raw_ = TestSurvey::easy().folder();
  fs::path out_ = TestSurvey::easy().fresh();
  IndexCache cache_;
  Plan plan_;
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

TEST_F(WorkFolders, OfAnotherVersionOpenTheirSurveyAndALineSaysToDetectAgain) {
  open({out_}, "another");
  ASSERT_TRUE(document().staged());
  EXPECT_FALSE(document().detected(0) || document().detected(1));
  EXPECT_THAT(document().notices(),
              Contains(AllOf(HasSubstr(out_.string()), HasSubstr("2 observations"), HasSubstr("Ctrl+D"))));
  press("schools.detect_all");
  document().settle();
  EXPECT_EQ(schools(0), 2U);
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
