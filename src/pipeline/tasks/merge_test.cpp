// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/product_example.h"
#include "io/product_file.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"
#include "pipeline/tasks/task_record.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Ten pings, a school in the last five that moves with 0.5 m/s to the north over ground.
ObservationProduct before_cut() {
  ObservationProduct p = example::empty("obs-0001", 10);
  example::add_school(p, 3, 5, 9, example::block(1, 1, 2, 20, 10));
  p.schools[0].speed_mps = example::kShip_mps;
  p.schools[0].course_deg = 0.0;
  p.schools[0].length_m = 20.0;
  return p;
}

/// Goes on one ping later, with the same school and another one far off.
ObservationProduct after_cut() {
  const Geographic start = destination({60.0, 5.0}, 10 * example::kPingSeconds * example::kShip_mps, 0.0);
  const TimeNs first = example::kStart + static_cast<TimeNs>(10 * example::kPingSeconds * 1e9);
  ObservationProduct p = example::empty("obs-0002", 10, start, first);
  p.cut_after = first - static_cast<TimeNs>(example::kPingSeconds * 1e9);
  example::add_school(p, 1, 0, 4, example::block(1, 1, 2, 20, 10));
  p.schools[0].length_m = 20.0;
  example::add_school(p, 2, 0, 4, example::block(0, 1, 2, 50, 5));
  for (SchoolPingRow& row : p.school_pings) {
    if (row.school_id != 2) continue;
    const Geographic far = destination({row.latitude, row.longitude}, 200.0, 0.0);
    row.latitude = far.latitude_deg;
    row.longitude = far.longitude_deg;
  }
  return p;
}

TEST(Merge, tells_each_code_once_an_observation) {
  MergeReport report;
  report.survey.observations = {before_cut(), after_cut()};
  report.survey.observations[0].diagnostics = {{DiagnosticCode::track_event, "", -1, 3, "school 1 appeared"},
                                               {DiagnosticCode::file_truncated, "a.raw", 700, -1, "cut"},
                                               {DiagnosticCode::no_grid, "", -1, -1, "one fan"},
                                               {DiagnosticCode::file_truncated, "b.raw", 9, -1, "cut"}};
  report.survey.observations[1].diagnostics = {{DiagnosticCode::no_position, "", -1, 4, "6 of 10 pings"}};
  EXPECT_THAT(note_lines(report),
              testing::ElementsAre("file-truncated: obs-0001: a.raw: byte 700: cut (and 1 more)",
                                   "no-grid: obs-0001: one fan", "no-position: obs-0002: ping 4: 6 of 10 pings"));
}

TEST(Merge, follows_a_school_over_a_cut) {
  const auto survey = merge({before_cut(), after_cut()});
  ASSERT_TRUE(survey) << to_line(survey.error());
  ASSERT_EQ(survey->schools.size(), 3U);
  EXPECT_EQ(survey->schools[0].continues, "");
  EXPECT_EQ(survey->schools[1].continues, "obs-0001/3");
  EXPECT_EQ(survey->schools[2].continues, "");
}

TEST(Merge, gates_are_those_of_the_products_recipe) {
  Recipe narrow;
  narrow.merge.gate_m = 0.0;
  narrow.merge.length_share = 0.0;
  ObservationProduct before = before_cut();
  ObservationProduct after = after_cut();
  before.schools[0].speed_mps = 0.0;  // then the school seems to have moved with the ship, by some metres
  ASSERT_EQ(merge({before, after})->schools[1].continues, "obs-0001/3");
  before.recipe_json = after.recipe_json = recipe_text(narrow);
  EXPECT_EQ(merge({before, after})->schools[1].continues, "");
  EXPECT_EQ(merge({before, after}, MergeParams{})->schools[1].continues, "obs-0001/3");
}

TEST(Merge, only_what_the_longest_duration_cut_is_joined) {
  ObservationProduct other_cause = after_cut();  // as near in time, but begun for another reason
  other_cause.cut_after = 0;
  EXPECT_EQ(merge({before_cut(), other_cause})->schools[1].continues, "");
  ObservationProduct next_but_one = after_cut();  // what it goes on from is not there
  next_but_one.cut_after += kSecondNs;
  EXPECT_EQ(merge({before_cut(), next_but_one})->schools[1].continues, "");
  ObservationProduct other_grid = after_cut();
  other_grid.grid->range.spacing_m = 1.0;
  EXPECT_EQ(merge({before_cut(), other_grid})->schools[1].continues, "");
}

TEST(Merge, a_school_that_ended_before_the_cut_is_not_continued) {
  ObservationProduct early = example::empty("obs-0001", 10);
  example::add_school(early, 3, 0, 5, example::block(1, 1, 2, 20, 10));
  EXPECT_EQ(merge({early, after_cut()})->schools[1].continues, "");
}

TEST(Merge, order_of_products_does_not_matter) {
  const ObservationProduct third = example::empty("obs-0010", 3, {61.0, 5.0}, example::kStart + 1000 * kSecondNs);
  const auto a = merge({before_cut(), after_cut(), third});
  const auto b = merge({third, after_cut(), before_cut()});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(csv_text(a->schools), csv_text(b->schools));
  EXPECT_EQ(csv_text(a->school_pings), csv_text(b->school_pings));
  EXPECT_EQ(a->observations.back().observation, "obs-0010");
  EXPECT_EQ(b->observations.back().observation, "obs-0010");
}

TEST(Merge, refuses_what_does_not_belong_together) {
  EXPECT_THAT(to_line(merge({before_cut(), before_cut()}).error()), HasSubstr("obs-0001 is there twice"));
  ObservationProduct other = after_cut();
  other.recipe_hash = "ffff";
  EXPECT_THAT(to_line(merge({before_cut(), other}).error()), HasSubstr("different recipes"));
  other = after_cut();
  other.stage_versions = "median 2";
  EXPECT_THAT(to_line(merge({before_cut(), other}).error()), HasSubstr("stage versions"));
  other = after_cut();
  other.input_hash = "other journal";
  EXPECT_TRUE(merge({before_cut(), other}));
}

TEST(Merge, names_are_ordered_by_number) {
  EXPECT_TRUE(name_less("obs-0002", "obs-0010"));
  EXPECT_TRUE(name_less("obs-9999", "obs-10000"));
  EXPECT_FALSE(name_less("obs-0002", "obs-0002"));
}

class MergeFolder : public testing::Test {
 protected:
  MergeFolder() : out_(fs::temp_directory_path() / ("sonar_merge_" + std::to_string(::getpid()))) {
    fs::create_directories(out_ / "products");
  }
  ~MergeFolder() override { fs::remove_all(out_); }
  MergeFolder(const MergeFolder&) = delete;
  MergeFolder& operator=(const MergeFolder&) = delete;
  void put(const ObservationProduct& p) const {
    ASSERT_TRUE(write_product(p, out_ / "products" / (p.observation + ".nc")));
  }
  void plan(const std::vector<std::string>& observations) const {
    Plan plan;
    for (const std::string& name : observations) {
      PlanTask task;
      task.observation = name;
      plan.tasks.push_back(task);
    }
    ASSERT_TRUE(write_file(out_ / "plan.json", plan_text(plan)));
  }
  [[nodiscard]] nlohmann::json survey_json() const { return nlohmann::json::parse(*read_file(out_ / "survey.json")); }
  fs::path out_;
  Work work_{1};
};

TEST_F(MergeFolder, writes_tables_map_and_summary) {
  put(before_cut());
  put(after_cut());
  const auto report = merge_folder(out_, {}, work_);
  ASSERT_TRUE(report) << to_line(report.error());
  EXPECT_TRUE(report->complete());
  const auto rows = read_csv_rows<SchoolRow>(out_ / "schools.csv");
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->at(1).continues, "obs-0001/3");
  EXPECT_EQ(read_csv_rows<SchoolPingRow>(out_ / "school_pings.csv")->size(), 15U);
  EXPECT_TRUE(fs::exists(out_ / "survey.gpkg"));
  const nlohmann::json json = survey_json();
  EXPECT_EQ(json["summary"]["schools"], 2) << "one goes on over the cut";
  EXPECT_EQ(json["summary"]["school_rows"], 3);
  EXPECT_EQ(json["summary"]["school_rows_continued"], 1);
  EXPECT_EQ(json["summary"]["school_rows_rejected"], 0);
  EXPECT_EQ(json["summary"]["schools_continued_over_a_cut"], 1);
  EXPECT_NEAR(json["summary"]["backscatter_total_m2"].get<double>(), 2 * 0.0316, 1e-12)
      << "of each ping of the example";
  EXPECT_EQ(json["provenance"]["recipe"]["recipe_version"], 1);
  EXPECT_EQ(json["observations"][0]["input_files"][0]["name"], "a file.raw");
  const std::string map = *read_file(out_ / "survey.gpkg");
  ASSERT_TRUE(merge_folder(out_, {}, work_));
  EXPECT_EQ(*read_file(out_ / "survey.gpkg"), map);
}

TEST_F(MergeFolder, lists_damaged_and_failed_observations) {
  put(before_cut());
  ASSERT_TRUE(write_file(out_ / "products" / "obs-0002.nc", "not a product"));
  const auto report = merge_folder(out_, {{"obs-0003", "it broke"}}, work_);
  ASSERT_TRUE(report) << to_line(report.error());
  EXPECT_FALSE(report->complete());
  const nlohmann::json json = survey_json();
  ASSERT_EQ(json["failures"].size(), 2U);
  EXPECT_EQ(json["failures"][0]["observation"], "obs-0003");
  EXPECT_EQ(json["failures"][1]["observation"], "obs-0002");
  EXPECT_EQ(json["summary"]["observations"], 1);
}

// What `status` tells of a task that failed.
TEST_F(MergeFolder, tells_why_a_task_failed) {
  plan({"obs-0001", "obs-0002", "obs-0003"});
  put(before_cut());
  TaskRecord record = record_of_this_process(0);
  ASSERT_TRUE(write_record(out_, "obs-0003", record)) << "at work, or gone without a word";
  record.error = "no such\nfile";
  ASSERT_TRUE(write_record(out_, "obs-0002", record));
  const auto report = merge_folder(out_, {}, work_);
  ASSERT_TRUE(report) << to_line(report.error());
  EXPECT_THAT(report->missing, testing::ElementsAre("obs-0003"));
  ASSERT_EQ(report->failures.size(), 1U);
  EXPECT_EQ(report->failures[0].observation, "obs-0002");
  EXPECT_EQ(report->failures[0].text, "no such?file");
  EXPECT_EQ(survey_json()["failures"][0]["error"], "no such?file");
  // A run of that observation knows better, and one of another has no part in it.
  EXPECT_EQ(merge_folder(out_, {{"obs-0002", "it broke"}}, work_)->failures[0].text, "it broke");
  EXPECT_THAT(merge_folder(out_, {}, work_, "obs-0001")->not_run, testing::ElementsAre("obs-0002", "obs-0003"));
}

// A number that the next observation, or the rest of the pings, would change is none.
TEST_F(MergeFolder, numbers_schools_once_all_is_observed) {
  plan({"obs-0001", "obs-0002"});
  const auto numbers = [this](std::vector<MergeFailure> failures = {}, const std::optional<std::string>& only = {}) {
    std::vector<std::int64_t> made;
    EXPECT_TRUE(merge_folder(out_, std::move(failures), work_, only));
    const auto rows = read_csv_rows<SchoolRow>(out_ / "schools.csv").value_or(std::vector<SchoolRow>{});
    for (const SchoolRow& row : rows) made.push_back(row.survey_school);
    return made;
  };
  put(after_cut());
  EXPECT_THAT(numbers({}, "obs-0002"), testing::ElementsAre(0, 0));
  ObservationProduct some_pings = before_cut();
  some_pings.diagnostics = {{DiagnosticCode::pings_left_out, "", -1, -1, "pings 0 to 9 of 20"}};
  put(some_pings);
  EXPECT_THAT(numbers(), testing::ElementsAre(0, 0, 0));
  EXPECT_EQ(survey_json()["survey_schools"].size(), 0U);
  EXPECT_EQ(survey_json()["partly_run"], nlohmann::json::array({"obs-0001"}));
  put(before_cut());
  EXPECT_THAT(numbers({{"obs-0002", "it broke"}}), testing::ElementsAre(0, 0, 0));
  // A file that gave nothing is as one that is not there yet.
  EXPECT_THAT(numbers({{std::nullopt, "b.raw: is empty"}}), testing::ElementsAre(1, 2, 3));
  EXPECT_FALSE(survey_json()["summary"]["complete"].get<bool>());
  EXPECT_THAT(numbers(), testing::ElementsAre(1, 2, 3));
  EXPECT_TRUE(survey_json()["summary"]["complete"].get<bool>());
  fs::remove(out_ / "products" / "obs-0001.nc");
  EXPECT_THAT(numbers(), testing::ElementsAre(2, 3)) << "what had a number keeps it";
}

TEST(RunOptions, pings_are_asked_of_the_observations_that_have_them) {
  Plan plan;
  for (const auto& [name, pings] : {std::pair{"obs-0001", 2}, std::pair{"obs-0002", 1}, std::pair{"obs-0003", 2}}) {
    PlanTask task;
    task.observation = name;
    task.pings = pings;
    plan.tasks.push_back(task);
  }
  RunOptions options;
  options.pings = PingSelection{1, 1};
  EXPECT_TRUE(require_possible(plan, options));
  EXPECT_FALSE(has_pings(plan.tasks[1], options.pings));
  options.only = "obs-0002";
  const auto of_short = require_possible(plan, options);
  ASSERT_FALSE(of_short);
  EXPECT_EQ(of_short.error().text, "--pings 1:1: obs-0002 has pings 0 to 0");
  options.only = std::nullopt;
  options.pings = PingSelection{2, 9};
  EXPECT_EQ(require_possible(plan, options).error().text,
            "--pings 2:9: obs-0001 has pings 0 to 1, no observation more");
}

TEST_F(MergeFolder, an_empty_folder_is_refused) {
  EXPECT_EQ(merge_folder(out_, {}, work_).error().code, ErrorCode::not_found);
  EXPECT_EQ(merge_folder(out_ / "none", {}, work_).error().code, ErrorCode::not_found);
  EXPECT_FALSE(fs::exists(out_ / "schools.csv"));
}

}  // namespace
}  // namespace sonar
