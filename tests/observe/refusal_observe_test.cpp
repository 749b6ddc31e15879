// SPDX-License-Identifier: Apache-2.0
// A survey that the system does not let us read for a while is no damaged survey: no product is made of it, none is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/simrad/test_bytes.h"
#include "observed_survey.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Refusal : public test::ObservedSurvey {
 protected:
  Refusal() {
    fs::create_directories(share_);
    for (const auto& file : fs::directory_iterator(folder_)) {
      if (file.path().extension() == ".raw") fs::copy_file(file.path(), raw_);
    }
    const std::vector<fs::path> paths{share_};
    auto survey = open_survey(paths, {}, {}, {}, work_);
    EXPECT_TRUE(survey);
    files_ = std::move(*survey);
  }
  const ObservationFiles& whole() { return files_.observations.at(0); }
  std::uint64_t offset_of(std::size_t ping) { return files_.entry(whole().pings[ping]).offset; }

  test::TemporaryFolder folder_of_test_;
  fs::path share_ = folder_of_test_.path() / "share";
  fs::path raw_ = share_ / "survey.raw";
  Work work_{2};
  SurveyFiles files_;
};

TEST_F(Refusal, AShareThatIsGoneGivesNoProduct) {
  fs::rename(share_, folder_of_test_.path() / "gone");
  const auto product = observe(files_, whole(), {}, {{}, {}, "test"}, work_);
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().code, ErrorCode::not_found);
  EXPECT_THAT(to_line(product.error()), testing::HasSubstr("survey.raw"));
  const auto again = remeasure(files_, whole(), *product_, {}, {{}, {}, "test"}, work_);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::not_found);
}

TEST_F(Refusal, AFileThatBecameShorterGivesNoProduct) {
  fs::resize_file(raw_, offset_of(20));
  const auto product = observe(files_, whole(), {}, {{}, {}, "test"}, work_);
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().code, ErrorCode::io);
  EXPECT_THAT(to_line(product.error()), testing::HasSubstr("shorter than when it was indexed"));
}

TEST_F(Refusal, WhatWasThereStaysAndIsMadeWhenTheShareIsBack) {
  RunOptions options;
  options.out = folder_of_test_.path() / "out";
  options.program_version = "test";
  const std::vector<fs::path> paths{share_};
  const auto run = [&](const Recipe& recipe, bool remeasure) {
    RunOptions asked = options;
    asked.remeasure = remeasure;
    const Plan plan = make_plan(files_, paths, {}, recipe, {{}, {}, "test"});
    return run_plan(plan, files_, {}, asked, work_);
  };
  ASSERT_TRUE(run({}, false));
  const fs::path made = product_path(options.out, whole().name);
  const std::string before = bytes_of(made);
  ASSERT_FALSE(before.empty());
  Recipe other;
  other.calibration.pulse_tolerance = 0.002;
  fs::rename(share_, folder_of_test_.path() / "gone");
  for (const bool remeasure : {false, true}) {
    const auto report = run(other, remeasure);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->done.empty());
    ASSERT_EQ(report->failures.size(), 1U) << remeasure;
    EXPECT_EQ(report->failures[0].observation, whole().name);
    EXPECT_EQ(bytes_of(made), before) << remeasure;
  }
  fs::rename(folder_of_test_.path() / "gone", share_);
  const auto report = run(other, false);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->done.size(), 1U);
  EXPECT_NE(bytes_of(made), before);
}

// Damage is what could be read and is no ping: that is so at every run.
TEST_F(Refusal, DamageIsNone) {
  std::fstream file(raw_, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(offset_of(20)));
  const std::string zeros(static_cast<std::size_t>(offset_of(21) - offset_of(20)), '\0');
  file.write(zeros.data(), static_cast<std::streamsize>(zeros.size()));
  file.close();
  const auto product = observe(files_, whole(), {}, {{}, {}, "test"}, work_);
  ASSERT_TRUE(product);
  for (std::size_t i = 0; i < product->pings.size(); ++i) EXPECT_EQ(product->pings[i].bad, i == 20) << "ping " << i;
  EXPECT_EQ(std::ranges::count(product->diagnostics, DiagnosticCode::ping_unreadable, &Diagnostic::code), 1);
}

}  // namespace
}  // namespace sonar
