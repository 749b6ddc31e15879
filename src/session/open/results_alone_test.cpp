// SPDX-License-Identifier: Apache-2.0
// Results of a run are looked at and reviewed where their raw files are gone.
#include "pipeline/tasks/results_alone.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "pipeline/stages/detected_cache.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/work_folders.h"
#include "session/live/live_watch.h"
#include "session/pictures/exports.h"
#include "session/playing/playback.h"
#include "session/test_results.h"
#include "session/words/preferences.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ResultsWithoutRaw : public TestResults {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(TestResults::SetUp());
    move_raw_away();
  }
  [[nodiscard]] std::ptrdiff_t notices_that_raw_files_are_gone() {
    return std::ranges::count_if(
        document().notices(), [](const std::string& line) { return line.find("are not here") != std::string::npos; });
  }
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

TEST_F(ResultsWithoutRaw, AreNotOpenedUponTheRawFilesOfAnotherSurvey) {
  open({out_});
  const fs::path other = TestSurvey::easy().fresh();
  std::ofstream(other / "other.raw") << "x";
  app_->dialogs.folder_to_open = [&] { return other.string(); };
  press("file.find_raw");
  document().settle();
  EXPECT_THAT(document().notices().back(), HasSubstr(other.string()));
  EXPECT_EQ(document().named(), std::vector<fs::path>{out_});
}

TEST_F(ResultsWithoutRaw, ArePlayed) {
  open({out_});
  document().look_at(0);
  document().settle();
  app_->playback->play();
  for (int i = 0; i < 20; ++i) {  // two pings a second
    app_->animations.tick(0.5 * i);
    document().settle();
  }
  EXPECT_GT(document().ping(), 2) << "maps and timelines follow";
}

TEST_F(ResultsWithoutRaw, AreNoRecordingToFollow) {
  open({out_});
  EXPECT_FALSE(app_->actions.find("file.live")->enabled());
  app_->live->set_on(true);
  EXPECT_FALSE(app_->live->on());
}

TEST_F(ResultsWithoutRaw, AreWrittenAsTheyWereDecided) {
  open({out_});
  Decision decision;
  decision.species = "herring";
  decide_on(workspace(), {survey_schools(document()).front()}, decision);
  document().settle();
  const fs::path written = TestSurvey::easy().fresh() / "written";
  export_results(workspace(), written);
  document().settle();
  EXPECT_THAT(document().notices().back(), HasSubstr("written: 2 observations"));
  const auto product =
      kept_detected(product_path(written, plan_.tasks[0].observation), "");  // no run takes it for its own
  ASSERT_TRUE(product);
  EXPECT_EQ(product->schools.front().species, "herring");
  EXPECT_EQ(product->schools.front().backscatter_m2, product_of(0).schools.front().backscatter_m2);
}

TEST_F(ResultsWithoutRaw, AreDrawnWithoutSamples) {
  open({out_});
  const fs::path folder = TestSurvey::easy().fresh();
  for (const PictureKind kind : {PictureKind::survey_map, PictureKind::slice_top, PictureKind::timeline}) {
    const fs::path file = folder / fmt::format("{}.png", static_cast<int>(kind));
    save_picture(workspace(), kind, file);
    document().settle();
    EXPECT_TRUE(fs::exists(file)) << document().notices().back();
  }
}

/// Journals lie where the program puts them.
class JournalsOfResults : public ResultsWithoutRaw {
 protected:
  void open_beside(std::vector<fs::path> paths) {
    DocumentOptions options = TestSurvey::options({});
    options.journal_folders = [](const fs::path& survey) { return std::vector{folder_beside(survey, "-work")}; };
    app_ = std::make_unique<AppModel>(queue_, options);
    document().open(std::move(paths));
    document().settle();
  }
  void plan_says(const fs::path& survey, const fs::path& session) {
    plan_.survey = {survey.string()};
    plan_.session = session.string();
    write_plan();
  }
  void call_herring() {
    Decision decision;
    decision.species = "herring";
    decide_on(workspace(), {survey_schools(document()).front()}, decision);
    document().settle();
  }
  [[nodiscard]] std::string species() { return document().state(0).schools.front()->masks.decided.species; }

  fs::path disk_ = fs::canonical(TestSurvey::easy().fresh());
};

TEST_F(JournalsOfResults, DecisionsAtTheOldPlaceComeAlongToWhereTheRawFilesAreFound) {
  std::ofstream(disk_ / "note.txt") << "the disk is here";
  plan_says(disk_ / "leg-1", {});
  open_beside({out_});
  EXPECT_EQ(document().journal_path(), disk_ / "leg-1-work" / "session.jsonl");
  call_herring();
  fs::copy(raw_, disk_ / "moved");
  open_beside({out_, disk_ / "moved"});
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().journal_path().parent_path(), disk_ / "moved-work");
  EXPECT_EQ(species(), "herring");
}

TEST_F(JournalsOfResults, ADiskThatIsNotMountedIsNotWrittenTo) {
  plan_says(disk_ / "leg-1", {});
  open_beside({out_});
  EXPECT_EQ(document().journal_path().parent_path(), folder_beside(out_, "-work"));
  EXPECT_TRUE(fs::is_empty(disk_));
}

TEST_F(JournalsOfResults, WhatTheRunWasGivenIsNotDecidedTwice) {
  std::ofstream(disk_ / "note.txt") << "the disk is here";
  const fs::path given = disk_ / "leg-1-work";
  plan_says(disk_ / "leg-1", {});
  open_beside({out_});
  call_herring();
  ASSERT_EQ(document().journal_path().parent_path(), given);
  plan_says(disk_ / "leg-1", given);
  open_beside({out_});
  EXPECT_EQ(document().journal_path().parent_path(), folder_beside(out_, "-work"));
  EXPECT_TRUE(std::ranges::none_of(*document().choices().lines,
                                   [](const JournalLine& line) { return is_decision(line.command); }));
}

TEST_F(ResultsWithoutRaw, OfTwoSurveysAreNotMixed) {
  const fs::path other = TestSurvey::easy().fresh();
  Recipe recipe;
  recipe.navigation.time_offset_s = 2.5;  // the same names, other pings
  ASSERT_TRUE(run_easy(other, recipe));
  Work work;
  const std::vector<fs::path> folders{out_, other};
  const auto results = open_results(folders, "gone", work);
  ASSERT_FALSE(results);
  EXPECT_EQ(results.error().code, ErrorCode::mismatch);
  const std::vector<fs::path> twice{out_, out_};
  EXPECT_TRUE(open_results(twice, "gone", work));
}

TEST_F(ResultsWithoutRaw, WithoutAPlanAreOpenedToo) {
  fs::remove(out_ / "plan.json");
  open({out_});
  ASSERT_NE(document().survey(), nullptr);
  EXPECT_EQ(document().state(0).schools.size(), 2U);
  EXPECT_THAT(document().nothing_shown(), HasSubstr("plan.json"));
}

TEST_F(ResultsWithoutRaw, ADamagedProductIsToldAndTheRestIsOpened) {
  const fs::path damaged = product_path(out_, plan_.tasks[0].observation);
  const fs::path copy = TestSurvey::easy().fresh() / "copy";
  fs::copy(out_, copy, fs::copy_options::recursive);
  fs::resize_file(damaged, fs::file_size(damaged) / 2);
  Work work;
  const auto merged = merge_folder(out_, {}, work);
  ASSERT_TRUE(merged) << to_line(merged.error());
  ASSERT_EQ(merged->failures.size(), 1U);
  const std::string line = merged->failures.front().text;
  open({out_});
  ASSERT_NE(document().survey(), nullptr);
  ASSERT_EQ(document().survey()->observations.size(), 1U);
  EXPECT_EQ(document().survey()->observations[0].name, plan_.tasks[1].observation);
  EXPECT_FALSE(document().state(0).schools.empty());
  EXPECT_EQ(std::ranges::count(document().notices(), line), 1) << "as sonarx merge says it";
  const std::vector<fs::path> folders{out_, copy};
  const auto whole = open_results(folders, "gone", work);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->products.size(), 2U) << "another folder has it";
  fs::resize_file(product_path(out_, plan_.tasks[1].observation), 100);
  open({out_});
  EXPECT_EQ(document().survey(), nullptr);
  EXPECT_EQ(std::ranges::count(document().notices(), line), 1);
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
