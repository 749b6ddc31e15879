// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <QCommandLinkButton>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "window_at_work.h"

namespace sonar {
namespace {

/// A window in which nothing is open yet.
class StartPage : public WindowAtWork {
 protected:
  void SetUp() override {
    survey_.clear();
    open();
  }
  [[nodiscard]] QWidget* page() { return window_->findChild<QWidget*>("start_page"); }
};

TEST_F(StartPage, LiesOverTheDocksUntilASurveyIsOpen) {
  ASSERT_TRUE(page()->isVisible());
  EXPECT_GE(page()->height(), window_->height() / 2);
  EXPECT_EQ(page()->width(), window_->width());
  auto* steps = window_->findChild<QLabel*>("start.steps");
  EXPECT_TRUE(steps->isVisible());
  EXPECT_GE(steps->height(), steps->heightForWidth(steps->width())) << "no line is cut";
  document().open({TestSurvey::easy().folder()});
  settle();
  EXPECT_FALSE(page()->isVisible());
  EXPECT_TRUE(view("top_slice")->isVisible());
}

TEST_F(StartPage, GrowsWithTheWindow) {
  window_->resize(1500, 950);
  settle();
  EXPECT_EQ(page()->width(), window_->width());
}

TEST_F(StartPage, OpensWhatWasOpenBeforeAtAClick) {
  close();
  cache_ = TestSurvey::easy().fresh();
  open();
  document().open({TestSurvey::easy().folder()});
  settle();
  preferences_ = app_->preferences;
  close();
  open();
  auto* before = window_->findChild<QToolButton*>("start.recent.1");
  ASSERT_NE(before, nullptr);
  EXPECT_TRUE(before->text().startsWith(QString::fromStdString(TestSurvey::easy().folder().filename().string())));
  EXPECT_TRUE(shows_something(before->icon().pixmap(before->iconSize()))) << "how it looked";
  keep_picture("start-recent");
  QTest::mouseClick(before, Qt::LeftButton);
  settle();
  ASSERT_NE(document().survey(), nullptr);
  EXPECT_FALSE(page()->isVisible());
}

// Another survey stands for the demo, which takes longer to make than a test may.
class DemoOnStartPage : public StartPage {
 protected:
  void SetUp() override {
    StartPage::SetUp();
    std::filesystem::create_directories(made_);
    std::filesystem::copy(TestSurvey::easy().folder(), made_, std::filesystem::copy_options::recursive);
    std::filesystem::create_directories(made_ / "truth" / "complete");
    qputenv("XDG_CACHE_HOME", cache_home_.c_str());
  }
  void TearDown() override {
    before_.isNull() ? qunsetenv("XDG_CACHE_HOME") : qputenv("XDG_CACHE_HOME", before_);
    StartPage::TearDown();
  }
  void push(const char* name) {
    auto* button = window_->findChild<QPushButton*>(name);
    ASSERT_NE(button, nullptr);
    ASSERT_TRUE(button->isVisible());
    click_on(button, {0.5 * button->width(), 0.5 * button->height()});
    EXPECT_TRUE(document().staged());
    EXPECT_EQ(document().paths(), std::vector{made_});
    EXPECT_FALSE(page()->isVisible());
  }
  const QByteArray before_ = qgetenv("XDG_CACHE_HOME");
  std::filesystem::path cache_home_ = TestSurvey::easy().fresh();
  std::filesystem::path made_ = cache_home_ / "sonar-explorer" / "demo-test";
};

TEST_F(DemoOnStartPage, IsAClickAway) { push("start.file.demo"); }

TEST_F(DemoOnStartPage, SoIsItsTutorial) {
  std::filesystem::path shown;
  app_->dialogs.show_page = [&shown](const std::filesystem::path& page) {
    shown = page;
    return true;
  };
  ASSERT_NO_FATAL_FAILURE(push("start.help.tutorial"));
  EXPECT_EQ(shown.filename(), "tutorial.md");
}

TEST_F(StartPage, IsUsedByKeysAlone) {
  auto* demo = window_->findChild<QPushButton*>("start.file.demo");
  auto* folder = window_->findChild<QPushButton*>("start.file.open_folder");
  folder->setFocus();
  QTest::keyClick(folder, Qt::Key_Tab);
  QTest::keyClick(window_->focusWidget(), Qt::Key_Tab);
  EXPECT_EQ(window_->focusWidget(), demo);
}

}  // namespace
}  // namespace sonar
