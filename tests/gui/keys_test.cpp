// SPDX-License-Identifier: Apache-2.0
// Single letters, what they say, and the window of preferences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>
#include <QTreeView>
#include <QTreeWidget>
#include <functional>

#include "gui/action_menus.h"
#include "session/playing/playback.h"
#include "window_at_work.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class Keys : public WindowAtWork {
 protected:
  /// What was said over a view last, though its time may be over on a busy machine; empty where nothing was.
  std::string said_over(const std::string& dock) {
    auto* label = view(dock)->findChild<QLabel*>("key_said");
    return label != nullptr ? label->text().toStdString() : std::string{};
  }
  bool is_said_over(const std::string& dock) {
    auto* label = view(dock)->findChild<QLabel*>("key_said");
    return label != nullptr && label->isVisible();
  }
  bool masks_on() { return workspace().display.values().masks; }
  /// Asks for the preferences by their key, and lets hands work in them.
  void in_preferences(const std::function<void(QDialog&)>& hands) {
    bool seen = false;
    QTimer waiting;
    QObject::connect(&waiting, &QTimer::timeout, window_.get(), [&] {
      auto* dialog = window_->findChild<QDialog*>("preferences");
      if (dialog == nullptr || !dialog->isVisible()) return;
      waiting.stop();
      EXPECT_TRUE(QTest::qWaitForWindowActive(dialog));
      seen = true;
      hands(*dialog);
      if (dialog->isVisible()) dialog->reject();
    });
    waiting.start(0);
    key(Qt::Key_Comma, Qt::ControlModifier);
    EXPECT_TRUE(seen);
    // Where no window manager does it, as here.
    window_->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    settle();
  }
  void press_button(QDialog& dialog, const char* text) {
    for (auto* button : dialog.findChildren<QPushButton*>()) {
      if (button->text().remove('&') == text && button->isVisible()) {
        return QTest::mouseClick(button, Qt::LeftButton);
      }
    }
    ADD_FAILURE() << text;
  }
  void show_page(QDialog& dialog, const char* title) {
    auto* bar = dialog.findChild<QTabWidget*>("pages")->tabBar();
    for (int i = 0; i < bar->count(); ++i) {
      if (bar->tabText(i) == title) QTest::mouseClick(bar, Qt::LeftButton, {}, bar->tabRect(i).center());
    }
  }
  void keep(QDialog& dialog, const char* name) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) dialog.grab().save(folder + "/" + name + ".png");
  }
};

TEST_F(Keys, ALetterActsWhereAViewHasTheKeyboardAndSaysThereWhatItDid) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  ASSERT_TRUE(view("top_slice")->hasFocus());
  key(Qt::Key_M);
  EXPECT_FALSE(masks_on());
  EXPECT_EQ(said_over("top_slice"), "Schools over the data: off");
  keep_picture("key-said");
  key(Qt::Key_M);
  EXPECT_EQ(said_over("top_slice"), "Schools over the data: on");
  key(Qt::Key_A);
  EXPECT_THAT(said_over("top_slice"), HasSubstr("school 1 accepted"));
  click_on(view("side_slice"), {5.0, 5.0});
  key(Qt::Key_H);
  EXPECT_FALSE(is_said_over("top_slice"));
  EXPECT_NE(said_over("side_slice"), "");
}

TEST_F(Keys, WhatCannotBeDoneSaysSo) {
  click_on(view("top_slice"), {3.0, 3.0});
  key(Qt::Key_Escape);
  ASSERT_FALSE(workspace().school());
  key(Qt::Key_R);
  EXPECT_EQ(said_over("top_slice"), "Reject: select a school first");
}

TEST_F(Keys, ElsewhereALetterActsNotAndIsToldInALine) {
  auto* slider = window_->findChild<QWidget*>("tolerance_db.slider");
  slider->setFocus(Qt::TabFocusReason);
  ASSERT_TRUE(slider->hasFocus());
  key(Qt::Key_M);
  EXPECT_TRUE(masks_on());
  EXPECT_THAT(window_->statusBar()->currentMessage().toStdString(), HasSubstr("M acts while a view or a table"));
  // In a field it is text.
  raise("schools");
  auto* filter = view("schools")->findChild<QLineEdit*>("filter");
  click_on(filter, {20.0, 5.0});
  ASSERT_TRUE(filter->hasFocus());
  type("m");
  EXPECT_EQ(filter->text(), "m");
  EXPECT_TRUE(masks_on());
  // What is no single letter acts from wherever.
  const bool filtered = workspace().display.values().filtered;
  key(Qt::Key_F8);
  EXPECT_NE(workspace().display.values().filtered, filtered);
}

TEST_F(Keys, AFieldThatIsDoneWithGivesTheKeyboardToAView) {
  click_on(view("top_slice"), {3.0, 3.0});
  auto* box = window_->findChild<QDoubleSpinBox*>("tolerance_db.box");
  box->setFocus();
  box->selectAll();
  type("7");
  key(Qt::Key_Return);
  EXPECT_TRUE(view("top_slice")->hasFocus());
  key(Qt::Key_M);
  EXPECT_FALSE(masks_on());
}

TEST_F(Keys, AViewThatIsClosedGivesTheKeyboardToAnother) {
  click_on(view("top_slice"), {3.0, 3.0});
  key(Qt::Key_1, Qt::AltModifier);
  ASSERT_TRUE(dock("top_slice")->isHidden());
  key(Qt::Key_M);
  EXPECT_FALSE(masks_on());
}

TEST_F(Keys, PreferencesFollowAtOnceAndCancelBringsBackWhatWasThere) {
  in_preferences([&](QDialog& dialog) {
    keep(dialog, "preferences-appearance");
    show_page(dialog, "Playback");
    auto* rate = dialog.findChild<QDoubleSpinBox*>("play_rate.box");
    rate->selectAll();
    QTest::keyClicks(rate, "5");
    QTest::keyClick(rate, Qt::Key_Return);
    EXPECT_TRUE(dialog.isVisible()) << "Enter ends the number, not the window";
    QApplication::processEvents();
    EXPECT_EQ(app_->playback->rate(), 5.0);
    keep(dialog, "preferences-playback");
    show_page(dialog, "Memory");
    keep(dialog, "preferences-memory");
    show_page(dialog, "Colours");
    keep(dialog, "preferences-colours");
    press_button(dialog, "Cancel");
  });
  EXPECT_EQ(app_->playback->rate(), 2.0);
  in_preferences([&](QDialog& dialog) {
    auto* size = dialog.findChild<QDoubleSpinBox*>("text_size_percent.box");
    size->selectAll();
    QTest::keyClicks(size, "150");
    QTest::keyClick(size, Qt::Key_Return);
    QApplication::processEvents();
    keep(dialog, "preferences-large-text");
    press_button(dialog, "OK");
  });
  EXPECT_EQ(workspace().window.values().text_size_percent, 150.0);
  keep_picture("preferences-large-window");
  ASSERT_TRUE(workspace().window.set("text_size_percent", 100.0));
  settle();
}

TEST_F(Keys, UnitsAreChosenInThePreferencesAndTheWholeWindowFollowsAtOnce) {
  const Target target = look_at_school();
  const auto read_out_line = [&] {
    move("side_slice", {4.0, 4.0});  // a pointer that stays where it is tells nothing
    move("side_slice", place_in("side_slice", target.voxel));
    return window_->statusBar()->findChild<QLineEdit*>("read_out")->text().toStdString();
  };
  const auto header = [&](const char* title) {
    const auto* model = view("schools")->findChild<QTreeView*>("rows")->model();
    for (int c = 0; c < model->columnCount(); ++c) {
      const QString text = model->headerData(c, Qt::Horizontal).toString();
      if (text.startsWith(title)) return text.toStdString();
    }
    return std::string();
  };
  auto& side = dynamic_cast<SliceModel&>(*app_->picture("side_slice"));
  EXPECT_THAT(read_out_line(), HasSubstr(" m, depth "));
  EXPECT_EQ(header("Depth"), "Depth [m]");
  EXPECT_EQ(side.picture()->plot.y.label, "depth (m)");
  in_preferences([&](QDialog& dialog) {
    show_page(dialog, "Units");
    const auto next = [&](const char* name, const char* what) {
      auto* box = dialog.findChild<QComboBox*>(name);
      ASSERT_NE(box, nullptr) << name;
      ASSERT_TRUE(box->isVisible()) << name;
      box->setFocus();
      while (box->currentText() != what && box->currentIndex() + 1 < box->count()) QTest::keyClick(box, Qt::Key_Down);
      EXPECT_EQ(box->currentText(), what);
    };
    next("length_unit", "Feet");
    next("speed_unit", "Knots");
    settle();
    EXPECT_EQ(header("Depth"), "Depth [ft]") << "at once";
    EXPECT_EQ(side.picture()->plot.y.label, "depth (ft)") << "at once";
    keep(dialog, "preferences-units");
    press_button(dialog, "OK");
  });
  EXPECT_EQ(workspace().units(), (Units{LengthUnit::feet, SpeedUnit::knots}));
  EXPECT_THAT(read_out_line(), HasSubstr(" ft, depth "));
  keep_picture("units-feet");
}

TEST_F(Keys, AKeyIsChangedByPressingItAndOneThatIsTakenIsRefused) {
  const auto row_of = [](QTreeWidget& list, const char* text) {
    const auto found = list.findItems(text, Qt::MatchExactly);
    EXPECT_EQ(found.size(), 1) << text;
    return found.front();
  };
  in_preferences([&](QDialog& dialog) {
    show_page(dialog, "Keys");
    auto* list = dialog.findChild<QTreeWidget*>("key_list");
    auto* told = dialog.findChild<QLabel*>("told");
    QTest::keyClicks(dialog.findChild<QLineEdit*>("key_words"), "over the data");
    QTreeWidgetItem* row = row_of(*list, "Schools over the data");
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(row).center());
    ASSERT_EQ(list->currentItem(), row);
    auto* field = dialog.findChild<QWidget*>("key");
    field->setFocus();
    QTest::keyClick(field, Qt::Key_N);
    EXPECT_THAT(told->text().toStdString(), HasSubstr("N is the key of \"Next unreviewed school\""));
    EXPECT_EQ(row->text(1), "M");
    keep(dialog, "preferences-keys-taken");
    QTest::keyClick(field, Qt::Key_G, Qt::ControlModifier | Qt::AltModifier);
    EXPECT_EQ(row->text(1), "Ctrl+Alt+G");
    dialog.findChild<QLineEdit*>("key_words")->clear();
    keep(dialog, "preferences-keys");
    press_button(dialog, "OK");
  });
  EXPECT_EQ(find_action(*window_, "display.masks")->shortcut(), QKeySequence("Ctrl+Alt+G"));
  EXPECT_EQ(app_->preferences.keys.count("display.masks"), 1U);
  click_on(view("top_slice"), {3.0, 3.0});
  key(Qt::Key_M);
  EXPECT_TRUE(masks_on());
  key(Qt::Key_G, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_FALSE(masks_on());
  in_preferences([&](QDialog& dialog) {
    show_page(dialog, "Keys");
    press_button(dialog, "All usual");
    press_button(dialog, "OK");
  });
  key(Qt::Key_M);
  EXPECT_TRUE(masks_on());
}

}  // namespace
}  // namespace sonar
