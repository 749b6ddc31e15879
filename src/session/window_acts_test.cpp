// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Guide, IsShownOutsideTheProgramElseALineSaysWhy) {
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  ASSERT_NE(app.actions.find("help.guide"), nullptr);
  std::vector<fs::path> shown;
  bool can = true;
  app.dialogs.show_page = [&](const fs::path& page) {
    shown.push_back(page);
    return can;
  };
  const auto& told = app.workspace.document.notices();
  show_page(app, "/doc/guide.html", "docs/guide.md");
  EXPECT_EQ(shown, std::vector<fs::path>{"/doc/guide.html"});
  EXPECT_TRUE(told.empty());
  can = false;
  show_page(app, "/doc/guide.html", "docs/guide.md");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told.back(), HasSubstr("/doc/guide.html"));
  show_page(app, {}, "docs/guide.md");
  ASSERT_EQ(told.size(), 2U);
  EXPECT_THAT(told.back(), HasSubstr("not installed"));
  EXPECT_EQ(shown.size(), 2U) << "nothing is shown where there is nothing";
}

}  // namespace
}  // namespace sonar
