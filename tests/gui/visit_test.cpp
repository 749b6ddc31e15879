// SPDX-License-Identifier: Apache-2.0
// A new user's visit, and a review of a hundred schools: how many acts of the hand they take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QPushButton>
#include <QTabBar>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>

#include "session/charts/chart_model.h"
#include "session/open/survey_schools.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Every click, key and text that a hand does is counted.
class Visit : public WindowAtWork {
 protected:
  void hit(Qt::Key which, Qt::KeyboardModifiers with = {}) {
    ++acts_;
    key(which, with);
  }
  void point(QWidget* widget, PixelPoint at) {
    ++acts_;
    click_on(widget, at);
  }
  void push(const char* button) {
    auto* one = window_->findChild<QPushButton*>(button);
    ASSERT_NE(one, nullptr) << button;
    ASSERT_TRUE(one->isVisible()) << button;
    point(one, {0.5 * one->width(), 0.5 * one->height()});
  }
  /// A file dialog: its text is one act, Enter another.
  std::string answer(const fs::path& text) {
    acts_ += 2;
    return text.string();
  }
  /// By its tab; one that the bar is too narrow for is found in the menu View: its title, its panels, its entry.
  void bring_forward(const char* id) {
    for (auto* bar : window_->findChildren<QTabBar*>()) {
      for (int tab = 0; tab < bar->count(); ++tab) {
        const QPoint at = bar->tabRect(tab).center();
        if (bar->tabText(tab) != dock(id)->windowTitle() || !bar->isVisible() || !bar->rect().contains(at)) continue;
        point(bar, {static_cast<double>(at.x()), static_cast<double>(at.y())});
        if (app_->picture(id)->seen()) return;
      }
    }
    acts_ += 3;
    raise(id);
  }
  int acts_ = 0;
};

class FirstVisit : public Visit {
 protected:
  void SetUp() override {
    survey_.clear();
    open();
  }
  fs::path out_ = TestSurvey::easy().fresh();
};

TEST_F(FirstVisit, FromStartToAnAcceptedExportedChartedSchoolInTwentyFiveActs) {
  QElapsedTimer clock;
  clock.start();
  app_->dialogs.folder_to_open = [this] { return answer(TestSurvey::easy().folder()); };
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return answer(out_); };
  ASSERT_NO_FATAL_FAILURE(push("start.file.open_folder"));
  ASSERT_NE(document().survey(), nullptr);
  ASSERT_NO_FATAL_FAILURE(push("detect"));
  const auto school = workspace().school();
  ASSERT_TRUE(school) << "the strongest school is selected";
  hit(Qt::Key_1);
  hit(Qt::Key_A);
  const auto decided = [&]() -> SchoolRow {
    for (const SurveySchool& one : survey_schools(document())) {
      if (one.name == *school) return one.decided();
    }
    return {};
  };
  EXPECT_EQ(decided().status, "accepted");
  EXPECT_EQ(decided().species, app_->preferences.species.front());
  hit(Qt::Key_E, Qt::ControlModifier);
  std::ifstream table(out_ / "schools.csv");
  const std::string written((std::istreambuf_iterator<char>(table)), std::istreambuf_iterator<char>());
  EXPECT_THAT(written, testing::HasSubstr("accepted"));
  bring_forward("chart");
  auto& chart = dynamic_cast<ChartModel&>(*app_->picture("chart"));
  ASSERT_TRUE(chart.seen());
  ASSERT_TRUE(chart.sight());
  std::set<SchoolName> charted;
  for (std::size_t row = 0; row < chart.sight()->data.rows.size(); ++row) charted.insert(chart.sight()->name_of(row));
  EXPECT_TRUE(charted.contains(*school));
  EXPECT_LE(acts_, 25);
  std::cout << "from start to an accepted, exported, charted school: " << acts_ << " acts, "
            << static_cast<double>(clock.elapsed()) / 1000.0 << " s\n";
}

class LongReview : public Visit {
 protected:
  /// Small schools all over two pings, none touching another.
  void paint_schools(int count) {
    const BeamGrid& grid = document().shown()->grid();
    for (int i = 0; i < count; ++i) {
      BrushCommand command;
      const int fan = 2 + 4 * (i / 2 % 5);
      const int beam = 1 + 3 * (i / 10 % 6);
      for (int f = fan; f < fan + 2; ++f) {
        for (int b = beam; b < beam + 2; ++b) {
          const auto at = static_cast<std::size_t>(f * grid.beams() + b);
          command.runs.push_back({grid.channel[at], 150 + 20 * (i / 60), 6});
        }
      }
      document().act(i % 2, std::move(command));
    }
    settle();
    ASSERT_EQ(document().state().schools.size(), static_cast<std::size_t>(count));
  }
  /// As fast as fingers are: nothing is waited for.
  void tap(Qt::Key which) { QTest::keyClick(window_->windowHandle(), which); }
};

TEST_F(LongReview, OfAHundredSchoolsTakesTwoKeysEach) {
  ASSERT_NO_FATAL_FAILURE(paint_schools(100));
  close();
  open();
  ASSERT_TRUE(workspace().school()) << "who comes back has one selected";
  raise("review");
  ASSERT_TRUE(app_->preferences.advance);
  for (int i = 0; i < 100; ++i) {
    tap(i % 3 == 0 ? Qt::Key_1 : Qt::Key_2);
    tap(i % 4 == 3 ? Qt::Key_R : Qt::Key_A);
  }
  settle();
  int accepted = 0;
  int rejected = 0;
  for (const auto& school : document().state().schools) {
    const auto& decided = school->masks.decided;
    accepted += decided.status == "accepted" ? 1 : 0;
    rejected += decided.status == "rejected" ? 1 : 0;
    EXPECT_FALSE(decided.species.empty()) << "school " << school->number;
  }
  EXPECT_EQ(accepted, 75);
  EXPECT_EQ(rejected, 25);
}

}  // namespace
}  // namespace sonar
