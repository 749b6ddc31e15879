// SPDX-License-Identifier: Apache-2.0
// The pages to calibrate by a sphere and to check the setup, by mouse.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <functional>

#include "gui/action_menus.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class SetupPagesInWindow : public WindowAtWork {
 protected:
  /// Opens a page from the menu's action, acts in it, and closes it.
  void in_page(const char* action, const char* name, const std::function<void(QDialog&)>& act) {
    QTimer looks;
    looks.setInterval(20);
    QObject::connect(&looks, &QTimer::timeout, window_.get(), [&] {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;  // not yet
      looks.stop();
      EXPECT_EQ(dialog->objectName(), name);
      act(*dialog);
      QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Close), Qt::LeftButton);
    });
    looks.start();
    find_action(*window_, action)->trigger();
    EXPECT_FALSE(looks.isActive()) << "the page did not open";
  }
};

TEST_F(SetupPagesInWindow, AFitThatFindsNoSphereSaysSoAndTheWindowGoesOn) {
  in_page("file.sphere", "sphere", [](QDialog& page) {
    auto* start = page.findChild<QPushButton*>("start");
    EXPECT_TRUE(start->isEnabled()) << "the open survey is the sphere run at first";
    EXPECT_FALSE(page.findChild<QPushButton*>("write")->isEnabled());
    EXPECT_FALSE(page.findChild<QPushButton*>("use")->isEnabled());
    QTest::mouseClick(start, Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !page.findChild<QLabel*>("told")->text().isEmpty(); }, 30'000));
    EXPECT_TRUE(start->isEnabled());
  });
  settle();
  EXPECT_TRUE(document().shown());
}

TEST_F(SetupPagesInWindow, APageCanBeClosedWhileItFits) {
  in_page("file.sphere", "sphere",
          [](QDialog& page) { QTest::mouseClick(page.findChild<QPushButton*>("start"), Qt::LeftButton); });
  settle();
  EXPECT_TRUE(document().shown());
}

TEST_F(SetupPagesInWindow, TheSetupCheckProposesNothingWithoutSchools) {
  in_page("file.setup_check", "setup", [this](QDialog& page) {
    EXPECT_TRUE(QTest::qWaitFor([&] { return document().all_measured() && !document().measuring(); }, 30'000));
    EXPECT_FALSE(page.findChild<QPushButton*>("use")->isEnabled());
  });
}

}  // namespace
}  // namespace sonar
