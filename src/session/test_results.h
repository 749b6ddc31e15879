// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/stages/detected_cache.h"
#include "session/test_app.h"
#include "session/test_run.h"

namespace sonar {

/// An app that opens what a run left of the small simulated survey.
class TestResults : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    auto plan = run_easy(out_);
    ASSERT_TRUE(plan) << to_line(plan.error());
    plan_ = *plan;
  }
  /// Begins a new run of the program, of some version, on the same journal.
  void open(std::vector<std::filesystem::path> paths, const std::string& version = "test") {
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
  void write_plan() const { std::ofstream(out_ / "plan.json") << plan_text(plan_); }
  /// The plan names raw files that are not there.
  void move_raw_away() {
    plan_.survey = {(out_ / "gone").string()};
    write_plan();
  }

  const std::filesystem::path& raw_ = TestSurvey::easy().folder();
  std::filesystem::path out_ = TestSurvey::easy().fresh();
  IndexCache cache_;
  Plan plan_;
};

}  // namespace sonar
