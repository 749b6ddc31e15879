// SPDX-License-Identifier: Apache-2.0
// Surveys are run in a window of their own, by mouse and keys, while work goes on in the main one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QComboBox>
#include <QDropEvent>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QProcess>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QUrl>
#include <cstdlib>
#include <set>

#include "gui/batch_window.h"
#include "session/batch/test_batch.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BatchInWindow : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    key(Qt::Key_R, Qt::ControlModifier);
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      if (widget->objectName() == "batch") runs_ = dynamic_cast<BatchWindow*>(widget);
    }
    ASSERT_NE(runs_, nullptr);
    EXPECT_FALSE(runs_->isModal());
    EXPECT_TRUE(QTest::qWaitForWindowActive(runs_));
  }
  [[nodiscard]] fs::path survey(const std::string& name) const { return copied_survey(root_ / name); }
  void press(const char* button) {
    auto* pressed = runs_->findChild<QPushButton*>(button);
    ASSERT_NE(pressed, nullptr) << button;
    EXPECT_TRUE(pressed->isEnabled()) << button;
    QTest::mouseClick(pressed, Qt::LeftButton);
    settle();
  }
  [[nodiscard]] bool can(const char* button) { return runs_->findChild<QPushButton*>(button)->isEnabled(); }
  [[nodiscard]] Batch& batch() { return *app_->batch; }
  [[nodiscard]] BatchTable* table() { return runs_->findChild<BatchTable*>("surveys"); }
  [[nodiscard]] std::string cell(int row, BatchRows::Column column) {
    return table()->model()->index(row, static_cast<int>(column)).data().toString().toStdString();
  }
  [[nodiscard]] std::string log() { return runs_->findChild<QPlainTextEdit*>("log")->toPlainText().toStdString(); }
  void add(const fs::path& folder) {
    app_->dialogs.folder_to_run = [folder] { return folder.string(); };
    press("add");
  }
  void click_row(int row) { QTest::mouseClick(table()->viewport(), Qt::LeftButton, {}, middle_of(row)); }
  [[nodiscard]] QPoint middle_of(int row) { return table()->visualRect(table()->model()->index(row, 0)).center(); }
  void wait_for_end() {
    while (batch().running()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    batch().settle();
    settle();
  }
  void keep(const std::string& name) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) runs_->grab().save(folder + "/batch-" + QString::fromStdString(name) + ".png");
  }

  fs::path root_ = TestSurvey::easy().fresh() / "a cruise with a long name, as cruises have 2026-11 North Sea";
  BatchWindow* runs_ = nullptr;
};

TEST_F(BatchInWindow, TwoSurveysAreRunWhileWorkGoesOnAndOneIsOpened) {
  keep("empty");
  EXPECT_FALSE(can("start")) << "nothing is listed";
  (void)survey("leg-1");
  (void)survey("leg-2");
  add(root_);  // the cruise's folder stands for both
  ASSERT_EQ(table()->model()->rowCount(), 2);
  EXPECT_EQ(cell(1, BatchRows::Column::results), root_.filename().string() + "/leg-2-out");
  add(root_ / "leg-1");
  EXPECT_THAT(runs_->findChild<QLabel*>("told")->text().toStdString(), HasSubstr("is in the list already"));
  auto* recipe = runs_->findChild<QComboBox*>("recipe");
  EXPECT_EQ(recipe->currentText(), "of the open survey");
  recipe->setFocus();
  QTest::keyClick(recipe, Qt::Key_Down);
  EXPECT_EQ(recipe->currentText(), "default");
  EXPECT_EQ(batch().recipe_choice(), BatchRecipe::preset);
  EXPECT_EQ(runs_->findChild<QSpinBox*>("jobs")->value(), 0) << "as of the command line";
  auto held = document().right_of_way().take();  // the runs go slowly, so that hands are quicker
  press("start");
  EXPECT_TRUE(batch().running());
  EXPECT_FALSE(can("start"));
  EXPECT_TRUE(can("stop"));
  // Meanwhile the main window steps through pings.
  const std::int64_t ping = document().ping();
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  key(Qt::Key_Right);
  key(Qt::Key_Right);
  EXPECT_EQ(document().ping(), ping + 2);
  ASSERT_TRUE(document().staged());
  EXPECT_EQ(document().staged()->ping_index, ping + 2) << "and its pings are there";
  EXPECT_TRUE(batch().running());
  keep("running");
  held.reset();
  wait_for_end();
  keep("done");
  for (int row = 0; row < 2; ++row) {
    EXPECT_EQ(cell(row, BatchRows::Column::state), "done");
    EXPECT_EQ(cell(row, BatchRows::Column::schools), "4");
    EXPECT_THAT(cell(row, BatchRows::Column::progress), HasSubstr("24 pings in "));
  }
  EXPECT_THAT(log(), HasSubstr("2 observations, 24 pings, 4 schools\n"));
  EXPECT_THAT(log(), HasSubstr((root_ / "leg-2-out" / "survey.gpkg").string()));
  EXPECT_EQ(runs_->findChild<QProgressBar*>("total")->format(), "2 surveys: 2 done");
  press("copy_log");
  EXPECT_EQ(QApplication::clipboard()->text().toStdString(), log());
  runs_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(runs_));
  click_row(1);
  QTest::mouseDClick(table()->viewport(), Qt::LeftButton, {}, middle_of(1));
  settle();
  EXPECT_EQ(document().named(), std::vector{root_ / "leg-2-out"});
  EXPECT_TRUE(document().detected(0) && document().detected(1)) << "those of the run";
  workspace().dark.set(true);
  settle();
  keep("dark");
}

TEST_F(BatchInWindow, RowsAreOrderedAndRemovedByKeysAndFoldersDropped) {
  QMimeData dropped;
  QList<QUrl> urls;
  for (const char* name : {"leg-1", "leg-2", "leg-3"}) {
    urls.append(QUrl::fromLocalFile(QString::fromStdString(survey(name).string())));
  }
  dropped.setUrls(urls);
  QDragEnterEvent enter(QPoint(200, 100), Qt::CopyAction, &dropped, Qt::LeftButton, {});
  QApplication::sendEvent(runs_, &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(200, 100), Qt::CopyAction, &dropped, Qt::LeftButton, {});
  QApplication::sendEvent(runs_, &drop);
  settle();
  ASSERT_EQ(table()->model()->rowCount(), 3);
  click_row(0);
  QTest::keyClick(table(), Qt::Key_Down, Qt::AltModifier);
  EXPECT_EQ(batch().surveys()[1].paths.front().filename(), "leg-1");
  EXPECT_EQ(table()->current(), 1U) << "the marked row is the same survey";
  QTest::keyClick(table(), Qt::Key_Up, Qt::AltModifier);
  EXPECT_EQ(batch().surveys()[0].paths.front().filename(), "leg-1");
  press("later");
  EXPECT_EQ(batch().surveys()[1].paths.front().filename(), "leg-1");
  QTest::keyClick(table(), Qt::Key_Delete);
  ASSERT_EQ(batch().surveys().size(), 2U);
  EXPECT_EQ(batch().surveys()[0].paths.front().filename(), "leg-2");
  EXPECT_TRUE(fs::exists(root_ / "leg-1")) << "no file is touched";
  press("add_open");
  EXPECT_EQ(batch().surveys().back().paths, std::vector{survey_});
  click_row(1);
  app_->dialogs.folder_to_save = [this](const std::string&, const std::string&) { return (root_ / "leg-2").string(); };
  press("out");
  EXPECT_THAT(runs_->findChild<QLabel*>("told")->text().toStdString(), HasSubstr("raw files"));
  keep("refused");
  app_->dialogs.folder_to_save = [this](const std::string&, const std::string&) { return (root_ / "other").string(); };
  press("out");
  EXPECT_EQ(batch().surveys()[1].out, root_ / "other");
  EXPECT_FALSE(runs_->findChild<QLabel*>("told")->isVisible());
}

TEST_F(BatchInWindow, ClosingAWindowWhileSurveysAreRunAsksFirst) {
  add(survey("leg-1"));
  int asked = 0;
  bool answer = false;
  app_->dialogs.yes = [&](const std::string& question) {
    ++asked;
    EXPECT_THAT(question, HasSubstr("Stop them?"));
    return answer;
  };
  const auto held = document().right_of_way().take();  // it does not end meanwhile
  press("start");
  EXPECT_FALSE(runs_->close());
  EXPECT_FALSE(window_->close());
  EXPECT_EQ(asked, 2);
  EXPECT_TRUE(batch().running() && !batch().stopping());
  EXPECT_TRUE(runs_->isVisible() && window_->isVisible());
  answer = true;
  EXPECT_TRUE(runs_->close());
  EXPECT_TRUE(batch().stopping());
  wait_for_end();
  EXPECT_EQ(batch().surveys()[0].state, BatchState::stopped);
  EXPECT_TRUE(runs_->close()) << "nothing runs any more";
  EXPECT_EQ(asked, 3);
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  key(Qt::Key_R, Qt::ControlModifier);
  EXPECT_TRUE(runs_->isVisible());
  EXPECT_EQ(cell(0, BatchRows::Column::state), "stopped");
}

// The program itself, in a process of its own, against the batch: the same files byte for byte, and the same lines.
TEST(BatchAndProgram, GiveTheSameBytesAndTellTheSameLines) {
  const char* program = std::getenv("SONARX");
  if (program == nullptr) GTEST_SKIP() << "SONARX, the command-line program, is not given";
  const auto ran = [&](const QStringList& words) {
    QProcess process;
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(program, words);
    EXPECT_TRUE(process.waitForFinished(-1));
    return process.readAll().toStdString();
  };
  const fs::path root = TestSurvey::easy().fresh();
  const fs::path out = root / "out";
  const auto path = [](const fs::path& file) { return QString::fromStdString(file.string()); };
  const std::string version = ran({"--version"});
  Recipe recipe;
  recipe.detect.tolerance_db = 8.0;
  ASSERT_TRUE(write_recipe((root / "R.json").string(), recipe));
  const std::string told =
      ran({"run", path(TestSurvey::easy().folder()), "--out", path(out), "--recipe", path(root / "R.json"), "-j", "1"});
  fs::rename(out, root / "of_program");
  ChangeQueue queue;
  DocumentOptions options = TestSurvey::options(root / "journal");
  options.program_version = version.substr(version.find(' ') + 1, version.find('\n') - version.find(' ') - 1);
  Document document(queue, options);
  Batch batch(queue, document);
  ASSERT_TRUE(batch.add({TestSurvey::easy().folder()}));
  ASSERT_TRUE(batch.set_out(0, out));
  ASSERT_TRUE(batch.set_recipe(BatchRecipe::of_file, root / "R.json"));
  ASSERT_TRUE(batch.start());
  batch.settle();
  const auto of_program = bytes_in(root / "of_program");
  const auto of_batch = bytes_in(out);
  ASSERT_GE(of_program.size(), 7U);
  for (const auto& [file, bytes] : of_program) {
    ASSERT_TRUE(of_batch.contains(file)) << file;
    EXPECT_TRUE(of_batch.at(file) == bytes) << file;
  }
  EXPECT_EQ(of_batch.size(), of_program.size());
  std::multiset<std::string> lines(batch.log().begin() + 1, batch.log().end() - 1);  // without its head and the end
  std::multiset<std::string> expected;
  for (const QString& line : QString::fromStdString(told).split('\n', Qt::SkipEmptyParts)) {
    expected.insert(line.toStdString());
  }
  EXPECT_EQ(lines, expected);
}

}  // namespace
}  // namespace sonar
