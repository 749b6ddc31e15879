// SPDX-License-Identifier: Apache-2.0
#include "session/batch/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "pipeline/survey/test_ek60.h"
#include "pipeline/tasks/merge.h"
#include "session/batch/batch_rows.h"
#include "session/batch/test_batch.h"
#include "session/test_run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BatchRuns : public testing::Test, protected TestBatch {
 protected:
  std::size_t lines_with(const std::string& words) {
    return static_cast<std::size_t>(std::count_if(batch_.log().begin(), batch_.log().end(),
                                                  [&](const auto& line) { return line.find(words) != line.npos; }));
  }
  /// Drains until the first observation has its product, while the run is slowed down.
  void run_until_first_product() {
    const auto held = document_.right_of_way().take();
    ASSERT_TRUE(batch_.start());
    while (batch_.running() && !fs::exists(product_path(out(0), "obs-0001"))) {
      queue_.wait();
      queue_.drain();
    }
    ASSERT_TRUE(batch_.running()) << "nothing was left to be stopped";
    batch_.stop();
    batch_.settle();
  }
};

// run_easy() goes over plan and products itself: what is compared with does not come through the batch.
TEST_F(BatchRuns, ProductsAreThoseOfARunBitForBitForAnyNumberOfThreads) {
  ASSERT_TRUE(run_easy(root_ / "expected"));
  const auto expected = bytes_in(root_ / "expected" / "products");
  ASSERT_EQ(expected.size(), 2U);
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  batch_.set_jobs(1);
  run();
  EXPECT_EQ(state(0), BatchState::done);
  EXPECT_EQ(state(1), BatchState::done);
  EXPECT_EQ(bytes_in(out(0) / "products"), expected);
  EXPECT_EQ(bytes_in(out(1) / "products"), expected);
  for (const char* file : {"plan.json", "schools.csv", "school_pings.csv", "survey.gpkg", "survey.json"}) {
    EXPECT_TRUE(fs::exists(out(0) / file)) << file;
  }
  EXPECT_EQ(batch_.surveys()[0].schools, 4U) << "as many as were simulated";
  EXPECT_EQ(batch_.share(), 1.0);
}

TEST_F(BatchRuns, WhatFailsStopsNoOtherAndHasOneLine) {
  const fs::path gone = survey("gone");
  const fs::path garbage = empty_folder("garbage");
  std::ofstream(garbage / "a.raw") << "this is no recording of any sounder";
  const fs::path ek60 = empty_folder("ek60");
  test::write_ek60(ek60 / "a.raw", TimeNs{1'790'000'000} * kSecondNs);
  const fs::path good = survey("good");
  fs::copy_file(garbage / "a.raw", good / "broken.raw");
  for (const fs::path& folder : {empty_folder("empty"), gone, garbage, ek60, good}) ASSERT_TRUE(batch_.add({folder}));
  fs::remove_all(gone);
  run();
  EXPECT_EQ(state(0), BatchState::failed);
  EXPECT_EQ(state(1), BatchState::failed);
  EXPECT_EQ(state(2), BatchState::failed);
  EXPECT_EQ(state(3), BatchState::done);
  EXPECT_EQ(state(4), BatchState::partly) << "one file of it is no recording";
  EXPECT_FALSE(batch_.surveys()[3].schools) << "nobody looked for any";
  EXPECT_EQ(lines_with("schools are not looked for in single-beam data"), 1U);
  EXPECT_EQ(batch_.surveys()[4].schools, 4U);
  EXPECT_EQ(batch_.surveys()[4].failed_files, 1U);
  for (const char* name : {"empty", "gone", "garbage/a.raw", "good/broken.raw"}) {
    EXPECT_EQ(lines_with("sonarx: " + (root_ / name).string() + ": "), 1U) << name;
  }
  EXPECT_EQ(lines_with("sonarx: "), 4U);
  for (const std::string& line : batch_.log()) EXPECT_EQ(line.find('\n'), line.npos);
  EXPECT_THAT(document_.notices().back(), HasSubstr("5 surveys: 1 done, 1 done in part, 3 failed"));
  EXPECT_EQ(batch_.log().back().substr(batch_.log().back().find("5 surveys")),
            "5 surveys: 1 done, 1 done in part, 3 failed");
}

TEST_F(BatchRuns, TheLogHasWhatARunTells) {
  ASSERT_TRUE(batch_.add({survey("one")}));
  run();
  Work work;
  const auto merged = merge_folder(out(0), {}, work);
  ASSERT_TRUE(merged);
  std::string expected;
  for (const std::string& note : note_lines(*merged)) expected += "note " + note + "\n";
  expected += merge_text(*merged, out(0));
  std::string told;
  const auto& log = batch_.log();
  ASSERT_GE(log.size(), 3U);
  for (std::size_t i = 1; i + 1 < log.size(); ++i) told += log[i] + "\n";  // between its head and the end
  EXPECT_EQ(told, expected);
  EXPECT_THAT(log.front(), AllOf(HasSubstr((root_ / "one").string()), HasSubstr(out(0).string())));
  const fs::path file = root_ / "log.txt";
  ASSERT_TRUE(batch_.save_log(file));
  std::ifstream in(file);
  const std::string saved{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(saved, log.front() + "\n" + told + log.back() + "\n");
  EXPECT_FALSE(batch_.save_log(root_ / "one" / "log.txt")) << "nothing is written where raw files lie";
}

TEST_F(BatchRuns, AStopKeepsFinishedObservationsAndTheNextStartMakesTheOthersAlone) {
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  run_until_first_product();
  EXPECT_EQ(state(0), BatchState::stopped);
  EXPECT_EQ(state(1), BatchState::waiting);
  EXPECT_EQ(lines_with("sonarx: interrupted; finished observations are kept"), 1U);
  EXPECT_FALSE(fs::exists(out(1)));
  auto left = bytes_in(out(0));
  ASSERT_EQ(left.size(), 2U) << "the plan and one product, nothing half made";
  EXPECT_TRUE(left.contains("plan.json") && left.contains("products/obs-0001.nc"));
  const auto written = fs::last_write_time(product_path(out(0), "obs-0001"));
  const auto node = fs::hard_link_count(product_path(out(0), "obs-0001"));
  run();
  EXPECT_EQ(state(0), BatchState::done);
  EXPECT_EQ(state(1), BatchState::done);
  EXPECT_EQ(fs::last_write_time(product_path(out(0), "obs-0001")), written) << "it was right already";
  EXPECT_EQ(fs::hard_link_count(product_path(out(0), "obs-0001")), node);
  EXPECT_EQ(bytes_in(out(0) / "products"), bytes_in(out(1) / "products")) << "as if nobody had stopped it";
}

TEST_F(BatchRuns, OneThatGoesWhileItRunsLeavesNothingHalfMade) {
  const fs::path raw = survey("one");
  {
    Batch other(queue_, document_);
    ASSERT_TRUE(other.add({raw}));
    ASSERT_TRUE(other.start());
    while (!fs::exists(root_ / "one-out" / "plan.json")) {
      queue_.wait();
      queue_.drain();
    }
  }
  queue_.drain();
  for (const auto& [file, bytes] : bytes_in(root_ / "one-out")) {
    EXPECT_TRUE(file == "plan.json" || file.starts_with("products/obs-")) << file;
  }
}

TEST_F(BatchRuns, RunInTheirOrderAndWhatComesLaterIsRunAsWell) {
  const fs::path three = survey("three");
  ASSERT_TRUE(batch_.add({survey("one"), survey("two")}));
  batch_.move(0, true);
  EXPECT_EQ(batch_.surveys()[0].paths, std::vector{root_ / "two"});
  ASSERT_TRUE(batch_.start());
  ASSERT_TRUE(batch_.add({three}));
  EXPECT_FALSE(batch_.remove(0)) << "it is running";
  EXPECT_FALSE(batch_.set_out(0, root_ / "elsewhere"));
  batch_.settle();
  std::vector<std::string> heads;
  for (const std::string& line : batch_.log()) {
    for (const char* name : {"one", "two", "three"}) {
      if (line.find((root_ / name).string() + ": its results") != line.npos) heads.emplace_back(name);
    }
  }
  EXPECT_THAT(heads, ElementsAre("two", "one", "three"));
  ASSERT_TRUE(batch_.remove(0));
  EXPECT_EQ(batch_.surveys().size(), 2U);
  EXPECT_TRUE(fs::exists(root_ / "two")) << "of the list alone";
}

TEST_F(BatchRuns, ADoneSurveyIsRunAgainUnderAnotherRecipeAlone) {
  ASSERT_TRUE(batch_.add({survey("one")}));
  run();
  const auto product = product_path(out(0), "obs-0001");
  const auto first = fs::last_write_time(product);
  ASSERT_TRUE(batch_.add({survey("two")}));
  EXPECT_THAT(*batch_.to_be_replaced(), IsEmpty());
  run();
  EXPECT_EQ(lines_with("one: its results"), 1U) << "it was done";
  EXPECT_EQ(fs::last_write_time(product), first);
  Recipe other;
  other.detect.tolerance_db = 7.0;
  ASSERT_TRUE(write_recipe((root_ / "R.json").string(), other));
  ASSERT_TRUE(batch_.set_recipe(BatchRecipe::of_file, root_ / "R.json"));
  EXPECT_THAT(*batch_.to_be_replaced(), ElementsAre(out(0), out(1)));
  run();
  EXPECT_EQ(lines_with("one: its results"), 2U);
  ASSERT_TRUE(run_easy(root_ / "expected", other));
  EXPECT_EQ(bytes_in(out(0) / "products"), bytes_in(root_ / "expected" / "products"));
}

TEST_F(BatchRuns, ResultsOfAnotherRecipeThatComeMeanwhileAreNotReplacedUnasked) {
  Recipe other;
  other.detect.tolerance_db = 7.0;
  ASSERT_TRUE(write_recipe((root_ / "R.json").string(), other));
  ASSERT_TRUE(batch_.set_recipe(BatchRecipe::of_file, root_ / "R.json"));
  ASSERT_TRUE(batch_.add({survey("one")}));
  run();
  const auto before = bytes_in(out(0));
  ASSERT_TRUE(batch_.remove(0));
  ASSERT_TRUE(batch_.set_recipe(BatchRecipe::preset));
  ASSERT_TRUE(batch_.add({survey("two")}));
  ASSERT_TRUE(batch_.start());
  ASSERT_TRUE(batch_.add({root_ / "one"}));
  ASSERT_TRUE(batch_.set_out(1, root_ / "one-out"));
  batch_.settle();
  EXPECT_EQ(state(0), BatchState::done);
  EXPECT_EQ(state(1), BatchState::failed);
  EXPECT_THAT(batch_.surveys()[1].why, HasSubstr("another recipe"));
  EXPECT_EQ(bytes_in(root_ / "one-out"), before);
  EXPECT_THAT(*batch_.to_be_replaced(), ElementsAre(root_ / "one-out")) << "now it is asked about";
  run();
  EXPECT_EQ(state(1), BatchState::done);
}

TEST_F(BatchRuns, TheRecipeOfTheWindowIsTheOneOfTheOpenSurvey) {
  EXPECT_EQ(batch_.recipe_choice(), BatchRecipe::preset) << "no survey is open";
  Recipe other;
  other.detect.tolerance_db = 7.0;
  document_.use_recipe(other);
  document_.open({TestSurvey::easy().folder()});
  document_.settle();
  EXPECT_EQ(batch_.recipe_choice(), BatchRecipe::of_window);
  ASSERT_TRUE(batch_.add({survey("one")}));
  run();
  const auto plan = read_plan(out(0) / "plan.json");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->recipe.detect.tolerance_db, 7.0);
  EXPECT_TRUE(plan->recipe.automatic) << "schools are looked for, though the window waits to be asked";
}

TEST_F(BatchRuns, GiveWayToWhatAUserWaitsFor) {
  ASSERT_TRUE(batch_.add({survey("one")}));
  const std::int64_t given = document_.right_of_way().given();
  {
    const auto held = document_.right_of_way().take();
    run();
  }
  EXPECT_GT(document_.right_of_way().given(), given);
  EXPECT_EQ(state(0), BatchState::done);
}

TEST_F(BatchRuns, RowsTellHowEachStands) {
  BatchRows rows(batch_);
  const auto text = [&](BatchRows::Column column) { return rows.cell(0, static_cast<std::size_t>(column)).text; };
  EXPECT_EQ(total_text(batch_), "");
  ASSERT_TRUE(batch_.add({survey("one")}));
  batch_.settle();
  EXPECT_EQ(text(BatchRows::Column::survey), (root_ / "one").string());
  EXPECT_THAT(text(BatchRows::Column::raw_files), HasSubstr("MB"));
  EXPECT_EQ(text(BatchRows::Column::results), (root_ / "one-out").string());
  EXPECT_EQ(text(BatchRows::Column::state), "waiting");
  std::vector<double> shares;
  std::string seen;
  const Listening heard_of(batch_.changed(), [&](BatchChange change) {
    if (change != BatchChange::progress) return;
    shares.push_back(std::get<double>(rows.cell(0, static_cast<std::size_t>(BatchRows::Column::progress)).key));
    seen += text(BatchRows::Column::progress) + "\n" + total_text(batch_) + "\n";
  });
  const auto held = document_.right_of_way().take();  // slow enough to be seen
  ASSERT_TRUE(batch_.start());
  while (batch_.running()) {
    if (queue_.drain() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  batch_.settle();
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_THAT(seen, AllOf(HasSubstr("observation 1 of 2: "), HasSubstr(" of 24 pings"), HasSubstr("survey 1 of 1, ")));
  EXPECT_EQ(text(BatchRows::Column::state), "done");
  EXPECT_THAT(text(BatchRows::Column::progress), HasSubstr("24 pings in "));
  EXPECT_EQ(text(BatchRows::Column::schools), "4");
  EXPECT_EQ(text(BatchRows::Column::problems), "");
  EXPECT_EQ(total_text(batch_), "1 survey: 1 done");
}

}  // namespace
}  // namespace sonar
