// SPDX-License-Identifier: Apache-2.0
// What lies round the survey: its depth chart, a folder that cannot be written to, the developer's overlay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <QTest>
#include <fstream>

#include "base/manual.h"
#include "gui/action_menus.h"
#include "session/open/open_demo.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Surroundings : public WindowAtWork {
 protected:
  void trigger(const std::string& id) {
    find_action(*window_, id)->trigger();
    settle();
  }
};

TEST_F(Surroundings, ADepthChartLiesUnderTheSurveyMapAndIsTakenAway) {
  raise("survey_map");
  const Image plain = app_->picture("survey_map")->image();
  app_->dialogs.file_to_open = [this](const auto&, const auto&) { return (survey_ / "truth" / "depth.tif").string(); };
  trigger("map.depths");
  const Image charted = app_->picture("survey_map")->image();
  EXPECT_TRUE(app_->picture("survey_map")->problem().empty());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) changed += plain.pixels[i] == charted.pixels[i] ? 0U : 1U;
  EXPECT_GT(changed, plain.pixels.size() / 4) << "the sea takes the chart's colours";
  trigger("map.no_depths");
  EXPECT_EQ(app_->picture("survey_map")->image(), plain);
}

TEST_F(Surroundings, AJournalThatMustGoElsewhereIsTold) {
  close();
  const fs::path blocked = TestSurvey::easy().fresh() / "survey-work";
  std::ofstream(blocked) << "a file where a folder is wanted";
  const fs::path own = TestSurvey::easy().fresh();
  pump_ = std::make_unique<QueuePump>([this] { gate_.pass(); });
  DocumentOptions options = TestSurvey::options(own);
  options.journal_folders = [blocked, own](const auto&) { return std::vector{blocked, own}; };
  app_ = std::make_unique<AppModel>(pump_->queue(), options);
  window_ = std::make_unique<MainWindow>(*app_);
  window_->show();
  document().open({survey_});
  settle();
  ASSERT_FALSE(document().notices().empty());
  EXPECT_THAT(document().notices().back(), testing::HasSubstr("cannot be written to"));
  EXPECT_THAT(window_->statusBar()->currentMessage().toStdString(), testing::HasSubstr(own.string()));
  document().act(EventCommand{"other", document().shown()->context().times[1], "kept"});
  settle();
  EXPECT_TRUE(fs::exists(own / "session.jsonl"));
}

TEST_F(Surroundings, NothingInTheStatusLineIsCut) {
  window_->resize(1280, 800);
  look_at_school();
  QStatusBar* status = window_->statusBar();
  auto* unfolded = window_->findChild<QWidget*>("unfolded");
  const auto at_the_foot = [&](const QString& words) {
    const int lines = unfolded->height() / unfolded->fontMetrics().height();
    EXPECT_EQ(unfolded->geometry().bottom(), status->geometry().bottom());
    EXPECT_LE(unfolded->fontMetrics().horizontalAdvance(words), lines * unfolded->width()) << "there is room for all";
  };
  const int views = view("top_slice")->height();
  move("top_slice", {100.0, 100.0});
  auto* read_out = window_->findChild<QLineEdit*>("read_out");
  ASSERT_FALSE(read_out->text().isEmpty());
  ASSERT_GT(read_out->fontMetrics().horizontalAdvance(read_out->text()), read_out->width())
      << "else this shows nothing";
  ASSERT_GT(unfolded->height(), 0);
  at_the_foot(read_out->text());
  keep_picture("read-out-unfolded");
  for (const auto* button : status->findChildren<QPushButton*>()) {
    if (!button->isVisible()) continue;
    EXPECT_GE(button->width(), button->fontMetrics().horizontalAdvance(button->text())) << button->text().toStdString();
  }
  document().tell("written: short");
  settle();
  EXPECT_EQ(unfolded->height(), 0);
  const std::string notice = "written: " + std::string(300, 'x') + "/survey-out";
  document().tell(notice);
  settle();
  ASSERT_GT(unfolded->height(), 0);
  at_the_foot(QString::fromStdString(notice));
  EXPECT_EQ(view("top_slice")->height(), views) << "nothing moves for it";
  keep_picture("notice-unfolded");
  for (QWidget* words : {static_cast<QWidget*>(status), unfolded}) {
    dock("diagnostics")->close();
    click_on(words, {20.0, 5.0});
    EXPECT_TRUE(dock("diagnostics")->isVisible()) << "the history of notices";
  }
  move("top_slice", {5.0, 5.0});
  status->clearMessage();
  EXPECT_TRUE(status->toolTip().isEmpty());
  EXPECT_EQ(unfolded->height(), 0);
}

TEST_F(Surroundings, TheProgressIsAsWideAsItsWords) {
  const auto& bar = *window_->statusBar()->findChild<QProgressBar*>();
  const int views = view("top_slice")->height();
  int seen = 0;
  const Listening listening(document().changes(), [&](DocumentChange change) {
    if (change != DocumentChange::progress || document().activity().stage.empty()) return;
    ++seen;
    EXPECT_TRUE(bar.text().contains(QString::fromStdString(document().activity().stage)));
    EXPECT_GE(bar.width(), bar.fontMetrics().horizontalAdvance(bar.text())) << bar.text().toStdString();
    EXPECT_EQ(view("top_slice")->height(), views) << "nothing moves for it";
  });
  look_at_school();
  key(Qt::Key_D);
  EXPECT_GT(seen, 2);
  EXPECT_FALSE(bar.isVisible());
}

TEST_F(Surroundings, F12ShowsHowLongPicturesTook) {
  move("side_slice", {5.0, 5.0});
  const QImage plain = view("top_slice")->grab().toImage();
  key(Qt::Key_F12);
  EXPECT_TRUE(workspace().latencies());
  EXPECT_NE(view("top_slice")->grab().toImage(), plain);
  const Target target = look_at_school();
  move("top_slice", place_in("top_slice", target.voxel));
  EXPECT_THAT(app_->picture("top_slice")->timing(), testing::MatchesRegex("[0-9.]+ ms, growth [0-9.]+ ms"));
  keep_picture("latencies");
  key(Qt::Key_F12);
  EXPECT_FALSE(workspace().latencies());
}

TEST_F(Surroundings, TheGuideIsShownOutsideTheProgram) {
  ASSERT_TRUE(app_->dialogs.show_page) << "the window answers";
  fs::path shown;
  app_->dialogs.show_page = [&](const fs::path& page) {
    shown = page;
    return true;
  };
  trigger("help.guide");
  EXPECT_EQ(shown, guide_place());
  trigger("help.new");
  EXPECT_EQ(shown, changes_place());
  EXPECT_EQ(shown.filename(), "CHANGELOG.md");
}

TEST_F(Surroundings, ADemoThatWasMadeOpensWithItsDepthChart) {
  const fs::path made = TestSurvey::easy().fresh() / "demo";
  fs::create_directories(made);
  fs::copy(survey_, made, fs::copy_options::recursive);
  fs::create_directories(made / "truth" / "complete");
  open_demo(*app_, made);
  settle();
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().paths().front(), made);
  EXPECT_EQ(workspace().depth_raster(), made / "truth" / "depth.tif");
}

}  // namespace
}  // namespace sonar
