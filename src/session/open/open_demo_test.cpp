// SPDX-License-Identifier: Apache-2.0
#include "session/open/open_demo.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "base/manual.h"
#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class DemoSurvey : public testing::Test, protected TestApp {
 protected:
  // NOLINTBEGIN(concurrency-mt-unsafe): no other thread is about
  void SetUp() override {
    if (const char* before = std::getenv("XDG_CACHE_HOME"); before != nullptr) before_ = before;
    ASSERT_EQ(::setenv("XDG_CACHE_HOME", cache_.c_str(), 1), 0);
  }
  void TearDown() override {
    app_.reset();
    before_ ? ::setenv("XDG_CACHE_HOME", before_->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
  }
  // NOLINTEND(concurrency-mt-unsafe)

  std::optional<std::string> before_;
  fs::path cache_ = TestSurvey::easy().fresh();
};

// Another survey stands for the demo, which takes longer to make than a test may.
TEST_F(DemoSurvey, IsOpenedFromTheMenuWhereItLiesInTheUsersCache) {
  const fs::path made = cache_ / "sonar-explorer" / "demo-test";
  fs::create_directories(made);
  fs::copy(TestSurvey::easy().folder(), made, fs::copy_options::recursive);
  fs::create_directories(made / "truth" / "complete");
  app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
  press("file.demo");
  document().settle();
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().paths().front(), made);

  app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
  fs::path shown;
  app_->dialogs.show_page = [&](const fs::path& page) {
    shown = page;
    return true;
  };
  press("help.tutorial");
  document().settle();
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().paths().front(), made);
  EXPECT_EQ(shown, tutorial_place());
  EXPECT_EQ(shown.filename(), "tutorial.md");
}

}  // namespace
}  // namespace sonar
