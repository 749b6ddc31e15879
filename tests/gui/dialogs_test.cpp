// SPDX-License-Identifier: Apache-2.0
// Files and folders that are chosen by hand in the dialogs themselves, from the menus: report, calibration, export.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QDialogButtonBox>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QTimer>
#include <QTreeView>
#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include "gui/action_menus.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class DialogsByHand : public WindowAtWork {
 protected:
  void SetUp() override {
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);  // a desktop's own cannot be reached from here
    WindowAtWork::SetUp();
  }
  void TearDown() override {
    WindowAtWork::TearDown();
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs, false);
  }

  /// Goes through the menu bar to an entry with the mouse, and answers the dialog that it opens.
  template <class Dialog>
  void choose(const std::string& id, const std::function<void(Dialog&)>& answer) {
    bool answered = false;
    QElapsedTimer waited;
    waited.start();
    QTimer looks;
    looks.setInterval(5);
    QObject::connect(&looks, &QTimer::timeout, window_.get(), [&] {
      auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr || !dialog->isVisible()) return;           // not yet
      if (!dialog->isActiveWindow()) return dialog->activateWindow();  // keys go to the window that is active
      looks.stop();
      answered = true;
      answer(*dialog);
      EXPECT_FALSE(dialog->isVisible()) << "nothing ended it";
      if (dialog->isVisible()) dialog->reject();
    });
    looks.start();
    QAction* entry = find_action(*window_, id);
    ASSERT_TRUE(entry->isEnabled()) << id;
    auto* bar = window_->findChild<QMenuBar*>();
    EXPECT_TRUE(click_in(*bar, bar->actions(), *entry)) << id << " is in no menu";
    while (!answered && waited.elapsed() < 4000) QApplication::processEvents(QEventLoop::WaitForMoreEvents, 50);
    EXPECT_TRUE(answered) << id << " opened no dialog";
    window_->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    settle();
  }
  /// Pasted: what is typed letter by letter Qt's own dialog completes to folders on the way, and chooses these too.
  static void paste_path(QFileDialog& dialog, const fs::path& path) {
    auto* edit = dialog.findChild<QLineEdit*>("fileNameEdit");
    ASSERT_NE(edit, nullptr);
    edit->setFocus();
    edit->selectAll();
    QApplication::clipboard()->setText(QString::fromStdString(path.string()));
    QTest::keyClick(edit, Qt::Key_V, Qt::ControlModifier);
  }
  static void press_button(const QDialog& dialog, QDialogButtonBox::StandardButton which) {
    auto* button = dialog.findChild<QDialogButtonBox*>()->button(which);
    ASSERT_NE(button, nullptr);
    EXPECT_TRUE(button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);
  }
  std::string told() { return document().notices().empty() ? std::string{} : document().notices().back(); }

  fs::path out_ = TestSurvey::easy().fresh();

 private:
  /// Whether the entry was found beneath these, and clicked.
  template <class Menu>
  static bool click_in(Menu& menu, const QList<QAction*>& entries, const QAction& entry) {
    for (QAction* one : entries) {
      const bool here = one == &entry;
      if (!here && (one->menu() == nullptr || !leads_to(*one->menu(), entry))) continue;
      QTest::mouseClick(&menu, Qt::LeftButton, {}, menu.actionGeometry(one).center());
      if (here) return true;
      const bool opened =
          QTest::qWaitFor([&] { return one->menu()->isVisible(); }, 2000);  // a menu in a menu takes a moment
      return opened && click_in(*one->menu(), one->menu()->actions(), entry);
    }
    return false;
  }
  static bool leads_to(const QMenu& menu, const QAction& entry) {
    for (const QAction* one : menu.actions()) {
      if (one == &entry || (one->menu() != nullptr && leads_to(*one->menu(), entry))) return true;
    }
    return false;
  }
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(DialogsByHand, TheReportIsSavedWhereTheDialogSays) {
  choose<QFileDialog>("export.report", [this](QFileDialog& dialog) {
    EXPECT_EQ(dialog.fileMode(), QFileDialog::Directory);
    paste_path(dialog, out_);
    press_button(dialog, QDialogButtonBox::Open);
  });
  EXPECT_EQ(told(), "written: " + (out_ / "report.pdf").string());
  const std::string report = text_of(out_ / "report.pdf");
  EXPECT_THAT(report, testing::StartsWith("%PDF"));
  EXPECT_THAT(report, testing::HasSubstr("%%EOF"));
}

// The table's factor of 1.5 dB lies over every channel: so much louder is what is shown, and the list of what is in force
// says where it comes from.
TEST_F(DialogsByHand, ACalibrationTableIsChosenAndIsInForce) {
  const fs::path table = out_ / "sphere.csv";
  {
    std::ofstream lines(table);
    lines << "channel,extra_factor_db\n";
    for (std::size_t i = 0; i < document().shown()->grid().channel.size(); ++i) lines << i << ",1.5\n";
  }
  const Target target = look_at_school();
  const double before_db = shown_sv_db(workspace(), target.voxel);
  choose<QFileDialog>("file.calibration", [](QFileDialog& dialog) { press_button(dialog, QDialogButtonBox::Cancel); });
  EXPECT_FALSE(document().shown()->recalibrated()) << "declined";
  choose<QFileDialog>("file.calibration", [&](QFileDialog& dialog) {
    paste_path(dialog, table);
    press_button(dialog, QDialogButtonBox::Open);
  });
  ASSERT_TRUE(document().shown()->recalibrated()) << told();
  EXPECT_NEAR(shown_sv_db(workspace(), target.voxel), before_db + 1.5, 0.03);
  choose<QDialog>("file.calibration_in_force", [](QDialog& dialog) {
    const QAbstractItemModel& rows = *dialog.findChild<QTreeView*>("rows")->model();
    int factors = 0;
    for (int column = 0; column < rows.columnCount(); ++column) {
      if (rows.headerData(column, Qt::Horizontal).toString().startsWith("Extra factor")) {
        for (int row = 0; row < rows.rowCount(); ++row)
          factors += rows.index(row, column).data().toString() == "1.50" ? 1 : 0;
      }
    }
    EXPECT_GT(factors, 0);
    EXPECT_EQ(factors, rows.rowCount()) << "every beam";
    press_button(dialog, QDialogButtonBox::Close);
  });
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(document().shown()->recalibrated());
}

TEST_F(DialogsByHand, AnExportGoesIntoTheNewFolderBesideTheSurveyOrLeavesNone) {
  const fs::path beside = fs::canonical(survey_).parent_path() / (survey_.filename().string() + "-out");
  ASSERT_FALSE(fs::exists(beside));
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  choose<QFileDialog>("export.csv", [&](QFileDialog& dialog) {
    EXPECT_EQ(fs::path(dialog.directory().absolutePath().toStdString()), beside);
    press_button(dialog, QDialogButtonBox::Cancel);
  });
  EXPECT_FALSE(fs::exists(beside)) << "declined: nothing is left";
  choose<QFileDialog>("export.csv", [](QFileDialog& dialog) { press_button(dialog, QDialogButtonBox::Open); });
  EXPECT_THAT(told(), testing::HasSubstr("in " + beside.string()));
  const std::string schools = text_of(beside / "schools.csv");
  EXPECT_EQ(std::count(schools.begin(), schools.end(), '\n'), 2) << "titles and one school";
  fs::remove_all(beside);
}

}  // namespace
}  // namespace sonar
