// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class ExportFolder : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
};

TEST_F(ExportFolder, BesideTheSurveyIsProposed) {
  paint(4, 5, 5, 5, 200);
  document().settle();
  const fs::path out = fs::canonical(TestSurvey::easy().folder()).parent_path() / "raw-out";
  std::string proposed;
  bool accepts = false;
  app_->dialogs.folder_to_save = [&](const auto&, const std::string& start) {
    EXPECT_TRUE(fs::is_directory(start)) << start << ": a dialog chooses only among folders that are there";
    proposed = start;
    return accepts ? start : std::string{};
  };
  press("export.csv");
  EXPECT_EQ(proposed, out.string());
  EXPECT_FALSE(fs::exists(out)) << "nothing is left where the human declines";
  press("export.raw-reduced");
  EXPECT_EQ(fs::path(proposed).filename(), "raw-reduced") << "other results may not lie beside raw files";
  fs::create_directory(out);
  std::ofstream(out / "plan.json") << "{}";
  press("export.results");
  EXPECT_EQ(proposed, out.string() + "-2") << "the first is a run's";
  fs::remove_all(out);
  accepts = true;
  press("export.csv");
  document().settle();
  EXPECT_THAT(document().notices().back(), testing::HasSubstr("written: 3 files in " + out.string()));
  fs::remove_all(out);
}

}  // namespace
}  // namespace sonar
