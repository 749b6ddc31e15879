// SPDX-License-Identifier: Apache-2.0
// Results of a run are looked at and reviewed where their raw files are gone.
#include "pipeline/tasks/results_alone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "pipeline/stages/detected_cache.h"
#include "pipeline/tasks/work_folders.h"
#include "session/test_app.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ResultsWithoutRaw : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    auto plan = run_easy(out_);
    ASSERT_TRUE(plan) << to_line(plan.error());
    plan_ = *plan;
    plan_.survey = {(out_ / "gone").string()};
    std::ofstream(out_ / "plan.json") << plan_text(plan_);
  }
  void open(std::vector<fs::path> paths) {
    app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
    document().open(std::move(paths));
    document().settle();
  }
  [[nodiscard]] ObservationProduct product_of(std::size_t task) const {
    auto product = kept_detected(product_path(out_, plan_.tasks[task].observation), plan_.tasks[task].key);
    EXPECT_TRUE(product);
    return product.value_or(ObservationProduct{});
  }
  [[nodiscard]] std::ptrdiff_t notices_that_raw_files_are_gone() {
    return std::ranges::count_if(
        document().notices(), [](const std::string& line) { return line.find("are not here") != std::string::npos; });
  }

  const fs::path& raw_ = TestSurvey::easy().folder();
  fs::path out_ = TestSurvey::easy().fresh();
  Plan plan_;
};

TEST_F(ResultsWithoutRaw, ShowTheSchoolsOfTheirProductsWithTheirFigures) {
  open({out_});
  ASSERT_NE(document().survey(), nullptr);
  ASSERT_EQ(document().survey()->observations.size(), 2U);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    ASSERT_TRUE(document().show(i));
    document().settle();
    const ObservationProduct was = product_of(i);
    ASSERT_TRUE(document().product(i));
    const ObservationProduct& is = *document().product(i);
    ASSERT_EQ(is.schools.size(), was.schools.size());
    ASSERT_EQ(is.school_pings.size(), was.school_pings.size());
    ASSERT_EQ(is.masks.size(), was.masks.size());
    for (std::size_t s = 0; s < was.schools.size(); ++s) {
      EXPECT_EQ(is.schools[s].backscatter_m2, was.schools[s].backscatter_m2);
      EXPECT_EQ(is.schools[s].n_pings, was.schools[s].n_pings);
    }
    for (std::size_t m = 0; m < was.masks.size(); ++m) EXPECT_EQ(is.masks[m].mask, was.masks[m].mask);
  }
}

TEST_F(ResultsWithoutRaw, SayInOneLineWhatWasExpectedAndWhereSamplesWouldStand) {
  open({out_});
  for (const std::int64_t ping : {3, 5, 7}) {
    document().look_at(ping);
    document().settle();
  }
  EXPECT_EQ(document().staged(), nullptr);
  EXPECT_EQ(notices_that_raw_files_are_gone(), 1) << "not at each ping";
  const std::string line = document().nothing_shown();
  EXPECT_THAT(line, AllOf(testing::StartsWith(out_.string() + ": the raw files are not here"),
                          HasSubstr((out_ / "gone").string()), HasSubstr(plan_.tasks.front().files.front())));
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(idle_text(*app_, "top_slice"), line);
  EXPECT_EQ(document().ping(), 7) << "tables, maps and timelines go to pings all the same";
}

TEST_F(ResultsWithoutRaw, AreReviewedAndTheDecisionsHoldWhenTheRawFilesAreBack) {
  open({out_});
  ASSERT_FALSE(document().state(0).schools.empty());
  const auto first = survey_schools(document()).front();
  Decision decision;
  decision.status = "accepted";
  decision.species = "herring";
  decide_on(workspace(), {first}, decision);
  document().settle();
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
  EXPECT_EQ(document().product(0)->schools.front().species, "herring") << "and its figures stay";
  EXPECT_EQ(document().product(0)->schools.front().backscatter_m2, product_of(0).schools.front().backscatter_m2);
  open({out_, raw_});
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().state(0).schools.front()->masks.decided.species, "herring");
}

TEST_F(ResultsWithoutRaw, FiguresOfASchoolThatWasChangedSinceAreNotKept) {
  open({out_});
  const ObservationProduct was = product_of(0);
  ObservationProduct other = was;
  other.masks.front().mask.runs.front().first_sample += 1;  // as if a human had moved a voxel of this ping
  const auto is = state_product_of_results(document().shown()->engine(), document().state(0), other);
  EXPECT_EQ(is.school_pings.size(), was.school_pings.size() - 1);
  EXPECT_TRUE(is.input_hash.empty());
}

TEST_F(ResultsWithoutRaw, FiguresUnderAnotherCalibrationAreNotKnown) {
  open({out_});
  CalibrateCommand calibrate;
  calibrate.calibration = document().recipe().calibration;
  calibrate.calibration.beams.push_back({channel(2, 5), kUnknown, kUnknown, 1.5});
  document().act(calibrate);
  document().settle();
  ASSERT_TRUE(document().product(0));
  EXPECT_TRUE(document().product(0)->school_pings.empty());
  EXPECT_FALSE(document().product(0)->masks.empty());
  document().undo();
  document().settle();
  EXPECT_EQ(document().product(0)->school_pings.size(), product_of(0).school_pings.size());
}

TEST_F(ResultsWithoutRaw, AnActThatNeedsSamplesSaysWhyItCannotBeDone) {
  open({out_});
  GrowCommand grow;
  grow.seeds = {{channel(2, 5), 100}};
  document().act(grow);
  document().settle();
  EXPECT_THAT(document().notices().back(), HasSubstr("the raw files are not here"));
}

TEST_F(ResultsWithoutRaw, AskWhereTheRawFilesLieNow) {
  open({out_});
  app_->dialogs.folder_to_open = [this] { return raw_.string(); };
  press("file.find_raw");
  document().settle();
  EXPECT_TRUE(document().staged());
  EXPECT_EQ(document().paths(), std::vector<fs::path>{raw_});
  EXPECT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_FALSE(app_->actions.find("file.find_raw")->enabled());
}

TEST_F(ResultsWithoutRaw, WithoutAPlanAreOpenedToo) {
  fs::remove(out_ / "plan.json");
  open({out_});
  ASSERT_NE(document().survey(), nullptr);
  EXPECT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_THAT(document().nothing_shown(), HasSubstr("plan.json"));
}

TEST_F(ResultsWithoutRaw, AndWithoutProductsAreRefused) {
  fs::remove_all(out_ / "products");
  open({out_});
  EXPECT_EQ(document().survey(), nullptr);
  EXPECT_EQ(notices_that_raw_files_are_gone(), 1);
}

// Journals know pings by the clock of the datagrams; products have the one that a user corrected.
TEST_F(ResultsWithoutRaw, HavePingsAtTheTimesOfTheDatagrams) {
  Recipe recipe;
  recipe.navigation.time_offset_s = 2.5;
  const fs::path out = TestSurvey::easy().fresh();
  ASSERT_TRUE(run_easy(out, recipe));
  Work work;
  const std::vector<fs::path> folders{out};
  const auto results = open_results(folders, "gone", work);
  ASSERT_TRUE(results);
  const std::vector<fs::path> paths{raw_};
  const auto raw = open_survey(paths, recipe.survey, recipe.navigation, {}, work);
  ASSERT_TRUE(raw);
  for (std::size_t o = 0; o < 2; ++o) {
    const auto& there = results->survey.observations[o];
    EXPECT_EQ(there.name, raw->observations[o].name);
    EXPECT_EQ(datagram_times(results->survey, there), datagram_times(*raw, raw->observations[o]));
    EXPECT_EQ(there.grid->channel, raw->observations[o].grid->channel);
    EXPECT_EQ(source_of(there), source_of(raw->observations[o]));
    EXPECT_EQ(there.config.survey_name, raw->observations[o].config.survey_name);
  }
}

}  // namespace
}  // namespace sonar
