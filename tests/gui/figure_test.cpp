// SPDX-License-Identifier: Apache-2.0
// Several views on a page: the dialog, by mouse and keys, and what it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QImage>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTimer>
#include <QToolButton>
#include <functional>
#include <utility>

#include "gui/action_menus.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class FigureOnPaper : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    app_->dialogs.file_to_save = [this](const std::string&, const std::string&, const std::string& name) {
      saved_ = out_ / name;
      return saved_.string();
    };
  }
  /// Opens the dialog by its key, and closes it.
  void compose(const std::function<void(QDialog&)>& act) {
    QTimer looks;
    looks.setInterval(20);
    QObject::connect(&looks, &QTimer::timeout, window_.get(), [act, &looks] {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;  // not yet
      looks.stop();
      EXPECT_EQ(dialog->objectName(), "figure");
      act(*dialog);
      QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Close), Qt::LeftButton);
    });
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    looks.start();
    key(Qt::Key_F, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_FALSE(looks.isActive()) << "the dialog did not open";
  }
  /// Turns the loop until something has come about.
  static void until(const std::function<bool()>& come) {
    QElapsedTimer waited;
    waited.start();
    while (!come() && waited.elapsed() < 60'000) QApplication::processEvents(QEventLoop::WaitForMoreEvents, 100);
    EXPECT_TRUE(come());
  }
  static void until_drawn(QDialog& dialog) {
    auto* write = dialog.findChild<QPushButton*>("write");
    until([write] { return write->isEnabled(); });
  }
  static void type_into(QWidget* box, const char* number) {
    ASSERT_NE(box, nullptr);
    box->setFocus();
    QTest::keyClick(box, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(box, number);
    QTest::keyClick(box, Qt::Key_Return);
    QApplication::processEvents();
  }
  static QListWidgetItem* item(QListWidget& views, const QString& title) {
    const auto found = views.findItems(title, Qt::MatchExactly);
    return found.isEmpty() ? nullptr : found.front();
  }
  /// A click on its box.
  static void tick(QListWidget& views, const QString& title) {
    QListWidgetItem* one = item(views, title);
    ASSERT_NE(one, nullptr) << title.toStdString();
    views.scrollToItem(one);
    const QRect place = views.visualItemRect(one);
    QTest::mouseClick(views.viewport(), Qt::LeftButton, {}, QPoint(place.left() + 10, place.center().y()));
    QApplication::processEvents();
  }
  static void keep_dialog(QDialog& dialog, const char* name) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) dialog.grab().save(folder + "/" + name + ".png");
  }

  fs::path saved_;
  fs::path out_ = TestSurvey::easy().fresh();
};

// From the key to the file: three views are ticked, paper and dots typed, and the PNG has them.
TEST_F(FigureOnPaper, ThreeViewsAreWrittenInMillimetresAndDotsAnInch) {
  compose([this](QDialog& dialog) {
    auto& views = *dialog.findChild<QListWidget*>("views");
    until_drawn(dialog);
    keep_dialog(dialog, "figure-first");
    for (const char* title : {"Slice from the side", "Volume", "Observation map"}) tick(views, title);
    tick(views, "Observation timeline");
    tick(views, "Observation map");
    EXPECT_EQ(workspace().figure.values().panels, "top_slice,observation_timeline,observation_map");
    // The timeline in a row of its own, below the others.
    views.setCurrentItem(item(views, "Observation timeline"));
    QTest::mouseClick(dialog.findChild<QPushButton*>("later"), Qt::LeftButton);
    until([this] { return workspace().figure.values().panels == "top_slice,observation_map,observation_timeline"; });
    QTest::mouseClick(dialog.findChild<QWidget*>("wide"), Qt::LeftButton, {}, QPoint(8, 8));
    until([this] { return workspace().figure.values().panels == "top_slice,observation_map,observation_timeline+"; });
    type_into(dialog.findChild<QDoubleSpinBox*>("width_mm.box"), "150");
    type_into(dialog.findChild<QDoubleSpinBox*>("height_mm.box"), "140");
    type_into(dialog.findChild<QSpinBox*>("dpi"), "200");
    until([this] { return workspace().figure.values().paper == FigurePaper::own; });
    EXPECT_EQ(workspace().figure.values().dpi, 200);
    until_drawn(dialog);
    QApplication::processEvents();
    keep_dialog(dialog, "figure-chosen");
    // What was typed last may just be drawn anew: then there is nothing to write yet.
    const auto* write = dialog.findChild<QPushButton*>("write");
    until([&] {
      if (write->isEnabled() && !fs::exists(saved_)) QTest::keyClick(&dialog, Qt::Key_S, Qt::ControlModifier);
      return fs::exists(saved_);
    });
    until([&] { return dialog.findChild<QLabel*>("told")->text().startsWith("written: "); });
  });
  const QImage picture(QString::fromStdString(saved_.string()));
  EXPECT_EQ(picture.size(), QSize(1181, 1102));  // 150 and 140 mm times 200 / 25.4
  EXPECT_NEAR(picture.dotsPerMeterX() * 0.0254, 200.0, 0.02);
  if (const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES"); !folder.isEmpty()) {
    picture.save(folder + "/figure-written.png");
  }
  // The next time it is as it was left.
  compose([](QDialog& dialog) {
    EXPECT_EQ(dialog.findChild<QSpinBox*>("dpi")->value(), 200);
    EXPECT_EQ(item(*dialog.findChild<QListWidget*>("views"), "Observation timeline (own row)")->checkState(),
              Qt::Checked);
  });
}

TEST_F(FigureOnPaper, WithoutAViewThePreviewSaysWhatIsExpectedAndNothingIsWritten) {
  compose([this](QDialog& dialog) {
    until_drawn(dialog);
    auto& views = *dialog.findChild<QListWidget*>("views");
    for (const char* title : {"Slice from above", "Slice from the side", "Volume", "Observation map"}) {
      tick(views, title);
    }
    EXPECT_EQ(workspace().figure.values().panels, "");
    until([&] { return !dialog.findChild<QPushButton*>("write")->isEnabled(); });
    keep_dialog(dialog, "figure-empty");
  });
  EXPECT_TRUE(saved_.empty());
}

TEST_F(FigureOnPaper, ADarkWindowComposesForPaperAllTheSame) {
  workspace().dark.set(true);
  settle();
  compose([](QDialog& dialog) {
    until_drawn(dialog);
    keep_dialog(dialog, "figure-dark");
    QTest::keyClick(&dialog, Qt::Key_S, Qt::ControlModifier);
    until([&] { return dialog.findChild<QLabel*>("told")->text().startsWith("written: "); });
  });
  const QImage picture(QString::fromStdString(saved_.string()));
  EXPECT_EQ(picture.pixelColor(2, 2), QColor(Qt::white));
}

// A dialog that is closed while its page is being drawn leaves nothing behind that is still at work for it.
TEST_F(FigureOnPaper, ItCanBeClosedWhileItDraws) {
  compose([](QDialog&) {});
  compose([](QDialog& dialog) { until_drawn(dialog); });
}

}  // namespace
}  // namespace sonar
