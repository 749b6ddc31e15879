// SPDX-License-Identifier: Apache-2.0
// Whoever works by keys alone, by a screen reader, with two fingers on a touch pad, or in another language.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAccessible>
#include <QAction>
#include <QDialog>
#include <QFontInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QNativeGestureEvent>
#include <QPointingDevice>
#include <QProcess>
#include <QTabBar>
#include <QTimer>
#include <QTranslator>
#include <QTreeView>
#include <QWheelEvent>
#include <QXmlStreamReader>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "gui/action_menus.h"
#include "gui/palette.h"
#include "view/contrast_example.h"
#include "window_at_work.h"

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Lines = std::vector<std::string>;

std::string name_of(const QObject& object) {
  return std::string(object.metaObject()->className()) + " '" + object.objectName().toStdString() + "'";
}

bool can_have_keyboard(const QWidget& widget) {
  return widget.isVisible() && widget.isEnabled() && widget.focusProxy() == nullptr &&
         (widget.focusPolicy() & Qt::TabFocus) != 0;
}

/// What can have the keyboard and that a screen reader has no name for.
Lines nameless(const QWidget& top) {
  Lines out;
  for (auto* widget : top.findChildren<QWidget*>()) {
    if (!can_have_keyboard(*widget)) continue;
    const QAccessibleInterface* told = QAccessible::queryAccessibleInterface(widget);
    if (told == nullptr || told->text(QAccessible::Name).trimmed().isEmpty()) out.push_back(name_of(*widget));
  }
  return out;
}

/// What has letters of less than 9 points, seen now or not.
Lines small_letters(const QWidget& top) {
  constexpr int kLeast_px = 12;  // 9 points where an inch has 96 pixels
  Lines out;
  for (auto* widget : top.findChildren<QWidget*>()) {
    const int size = QFontInfo(widget->font()).pixelSize();
    if (size < kLeast_px) out.push_back(name_of(*widget) + ": " + std::to_string(size) + " px");
  }
  return out;
}

class Access : public WindowAtWork {
 protected:
  /// Opens a dialog by its action and lets hands work in it.
  void in_dialog(const std::string& action, const char* name, const std::function<void(QDialog&)>& hands) {
    bool seen = false;
    QTimer waiting;
    QObject::connect(&waiting, &QTimer::timeout, window_.get(), [&] {
      auto* dialog = window_->findChild<QDialog*>(name);
      if (dialog == nullptr || !dialog->isVisible()) return;
      waiting.stop();
      seen = true;
      hands(*dialog);
      if (dialog->isVisible()) dialog->reject();
    });
    waiting.start(0);
    find_action(*window_, action)->trigger();
    while (!seen && waiting.isActive() && window_->findChild<QDialog*>(name) != nullptr) QApplication::processEvents();
    EXPECT_TRUE(seen) << action;
    settle();
  }
  void in_every_dialog(const std::function<void(QDialog&)>& hands) {
    in_dialog("edit.preferences", "preferences", hands);
    in_dialog("file.recipe", "recipe", hands);
    in_dialog("file.figure", "figure", hands);
    in_dialog("noise.choose", "parameters", hands);
    in_dialog("file.calibration_in_force", "rows_dialog", hands);
    in_dialog("file.sphere", "sphere", hands);
    in_dialog("file.setup_check", "setup", hands);
    in_dialog("help.keys", "key_sheet", hands);
  }
  QWidget* batch_window() {
    find_action(*window_, "file.run_surveys")->trigger();
    settle();
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      if (widget->objectName() == "batch" && widget->isVisible()) return widget;
    }
    return nullptr;
  }
};

TEST_F(Access, WhateverCanHaveTheKeyboardHasAName) {
  EXPECT_THAT(nameless(*window_), IsEmpty());
  for (const RowsDock& one : app_->lists) {
    raise(one.id);
    EXPECT_THAT(nameless(*dock(one.id)), IsEmpty()) << one.id;
  }
  in_every_dialog(
      [](QDialog& dialog) { EXPECT_THAT(nameless(dialog), IsEmpty()) << dialog.objectName().toStdString(); });
  ASSERT_NE(batch_window(), nullptr);
  app_->dialogs.show_integration();
  app_->dialogs.show_biomass();
  settle();
  for (QWidget* top : QApplication::topLevelWidgets()) EXPECT_THAT(nameless(*top), IsEmpty()) << name_of(*top);
  QLineEdit without(window_.get());
  without.show();
  EXPECT_THAT(nameless(*window_), testing::SizeIs(1)) << "one without a name is found";
}

// In the window, in every dialog and in the windows beside it, of a small screen, and however small a human wants it.
// What is drawn has a test of its own, LeastText.
TEST_F(Access, LettersHaveNinePointsAtLeast) {
  window_->resize(1280, 800);
  for (const double percent : {100.0, 70.0}) {
    ASSERT_TRUE(workspace().window.set("text_size_percent", percent));
    in_every_dialog([&](QDialog& dialog) {
      EXPECT_THAT(small_letters(dialog), IsEmpty()) << dialog.objectName().toStdString() << ", " << percent << " %";
    });
    ASSERT_NE(batch_window(), nullptr);
    app_->dialogs.show_integration();
    app_->dialogs.show_biomass();
    settle();
    for (const QWidget* top : QApplication::topLevelWidgets()) {
      EXPECT_THAT(small_letters(*top), IsEmpty()) << name_of(*top) << ", " << percent << " %";
    }
  }
  ASSERT_TRUE(workspace().window.set("text_size_percent", 100.0));
  QLabel small("a", window_.get());
  QFont font = small.font();
  font.setPixelSize(11);
  small.setFont(font);
  EXPECT_THAT(small_letters(*window_), testing::SizeIs(1)) << "one that is smaller is found";
}

TEST_F(Access, APictureIsReadInASentence) {
  QAccessibleInterface* told = QAccessible::queryAccessibleInterface(view("top_slice"));
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->role(), QAccessible::Graphic);
  EXPECT_EQ(told->text(QAccessible::Name), "Slice from above");
  EXPECT_THAT(told->text(QAccessible::Description).toStdString(), HasSubstr("Slice of fan "));
  document().look_at(5);
  settle();
  EXPECT_THAT(told->text(QAccessible::Description).toStdString(), HasSubstr("ping 5 of "));
}

TEST_F(Access, TabReachesEveryPanelAndBringsItInFront) {
  std::set<std::string> missing;
  for (auto* one : window_->findChildren<QDockWidget*>()) {
    if (!one->isHidden()) missing.insert(one->objectName().toStdString());
  }
  ASSERT_GT(missing.size(), 10U);
  view("top_slice")->setFocus();
  constexpr int kMostSteps = 1000;
  for (int step = 0; step < kMostSteps && !missing.empty(); ++step) {
    QTest::keyClick(window_->windowHandle(), Qt::Key_Tab);
    QApplication::processEvents();
    for (QWidget* at = QApplication::focusWidget(); at != nullptr; at = at->parentWidget()) {
      if (qobject_cast<QDockWidget*>(at) == nullptr) continue;
      EXPECT_FALSE(at->visibleRegion().isEmpty()) << at->objectName().toStdString() << " has the keyboard unseen";
      missing.erase(at->objectName().toStdString());
    }
  }
  settle();
  EXPECT_THAT(missing, IsEmpty());
}

TEST_F(Access, TabsOfDocksHaveWholeWords) {
  const auto bars = window_->findChildren<QTabBar*>(Qt::FindDirectChildrenOnly);
  ASSERT_FALSE(bars.isEmpty());
  for (QTabBar* bar : bars) {
    EXPECT_EQ(bar->elideMode(), Qt::ElideNone);
    for (int i = 0; bar->isVisible() && i < bar->count(); ++i) {
      EXPECT_GE(bar->tabRect(i).width(), bar->fontMetrics().horizontalAdvance(bar->tabText(i)))
          << bar->tabText(i).toStdString();
    }
  }
  EXPECT_EQ(window_->size(), QSize(1600, 1000).boundedTo(QApplication::primaryScreen()->availableSize()))
      << "the window is no wider for it";
}

double contrast(const QColor& a, const QColor& b) {
  const auto plain = [](const QColor& c) {
    const auto part = [](int value) { return static_cast<std::uint8_t>(value); };
    return Rgba8{part(c.red()), part(c.green()), part(c.blue()), 255};
  };
  return contrast_example::contrast(plain(a), plain(b));
}

TEST_F(Access, TextStandsOutInBothThemes) {
  for (const bool dark : {false, true}) {
    take_theme(dark);
    const QPalette now = QApplication::palette();
    for (const auto& [text, ground] : {std::pair(QPalette::WindowText, QPalette::Window),
                                       {QPalette::Text, QPalette::Base},
                                       {QPalette::ButtonText, QPalette::Button},
                                       {QPalette::Text, QPalette::AlternateBase},
                                       {QPalette::HighlightedText, QPalette::Highlight},
                                       {QPalette::ToolTipText, QPalette::ToolTipBase}}) {
      EXPECT_GE(contrast(now.color(text), now.color(ground)), 4.5) << dark << " " << text;
    }
    EXPECT_GE(contrast(now.color(QPalette::PlaceholderText), now.color(QPalette::Base)), 4.5) << dark;
  }
  take_theme(false);
}

TEST_F(Access, TwoFingersMoveASliceAndAWheelDoesNot) {
  const Target target = look_at_school();
  QWidget* slice = view("top_slice");
  const PixelPoint at = place_in("top_slice", target.voxel);
  const QPointF here(at.x, at.y);
  const QPointF global = slice->mapToGlobal(here);
  const auto* device = QPointingDevice::primaryPointingDevice();
  QNativeGestureEvent pinch(Qt::ZoomNativeGesture, device, 2, here, here, global, 1.0, QPointF());
  QApplication::sendEvent(slice, &pinch);
  settle();
  auto* model = dynamic_cast<SliceModel*>(app_->picture("top_slice"));
  ASSERT_TRUE(model->zoomed());
  EXPECT_NEAR(place_in("top_slice", target.voxel).x, at.x, 1.0);
  QWheelEvent fingers(here, global, QPoint(24, -16), QPoint(60, -40), Qt::NoButton, {}, Qt::ScrollUpdate, false);
  QApplication::sendEvent(slice, &fingers);
  settle();
  EXPECT_NEAR(place_in("top_slice", target.voxel).x, at.x + 24.0, 1.5);
  EXPECT_NEAR(place_in("top_slice", target.voxel).y, at.y - 16.0, 1.5);
  EXPECT_EQ(workspace().slices().fan, target.voxel.fan);
  // Under X11 some wheels have pixels too; they have no phase.
  QWheelEvent wheel(here, global, QPoint(0, 120), QPoint(0, 120), Qt::NoButton, {}, Qt::NoScrollPhase, false);
  QApplication::sendEvent(slice, &wheel);
  settle();
  EXPECT_NE(workspace().slices().fan, target.voxel.fan) << "a wheel goes through the fans";
}

/// A language that has every text between brackets.
class Brackets : public QTranslator {
 public:
  [[nodiscard]] bool isEmpty() const override { return false; }
  [[nodiscard]] QString translate(const char* context, const char* text, const char* /*which*/,
                                  int /*number*/) const override {
    if (std::string_view(context) != "sonar") return {};
    if (*text != '\0') asked_.insert(text);
    return "[" + QString::fromUtf8(text) + "]";
  }
  /// All that was to be translated.
  [[nodiscard]] const std::set<std::string>& asked() const { return asked_; }

 private:
  mutable std::set<std::string> asked_;
};

bool in_language(const QString& text) {
  const bool words = std::any_of(text.begin(), text.end(), [](QChar c) { return c.isLetter(); });
  return !words || text.contains('[');
}

class InAnotherLanguage : public Access {
 protected:
  void SetUp() override {
    QCoreApplication::installTranslator(&brackets_);
    Access::SetUp();
  }
  void TearDown() override {
    Access::TearDown();
    QCoreApplication::removeTranslator(&brackets_);
  }
  /// Labels, buttons and placeholders that are seen and are English. What is told (objects of these names) is made as it
  /// happens, and rows are data.
  static Lines english(const QWidget& top) {
    static const std::set<QString> kTold{
        "told",        "play_rate", "live_text", "preview_before_schools", "preview_after_schools",
        "recipe_file", "key_said",  "run"};
    Lines out;
    const auto look = [&](const QWidget& at, const QString& text) {
      const bool qt = at.objectName().startsWith("qt_") || at.parentWidget()->inherits("QDialogButtonBox");
      if (!at.isVisible() || qt || kTold.contains(at.objectName()) || in_language(text)) return;
      out.push_back(name_of(at) + ": " + text.toStdString());
    };
    for (auto* one : top.findChildren<QLabel*>()) look(*one, one->text());
    for (auto* one : top.findChildren<QAbstractButton*>()) look(*one, one->text());
    for (auto* one : top.findChildren<QLineEdit*>()) look(*one, one->placeholderText());
    for (auto* bar : top.findChildren<QTabBar*>()) {
      for (int i = 0; i < bar->count(); ++i) look(*bar, bar->tabText(i));
    }
    for (auto* list : top.findChildren<QTreeView*>()) {
      for (int c = 0; c < list->model()->columnCount(); ++c)
        look(*list, list->model()->headerData(c, Qt::Horizontal).toString());
    }
    return out;
  }

  Brackets brackets_;
};

TEST_F(InAnotherLanguage, MenusAndDocksSpeakIt) {
  for (const QAction* title : window_->menuBar()->actions()) {
    EXPECT_TRUE(in_language(title->text())) << title->text().toStdString();
  }
  for (const Action& action : app_->actions.list()) {
    const QAction* shown = find_action(*window_, action.id);
    ASSERT_NE(shown, nullptr) << action.id;
    const bool made_now = action.text_now && !action.text_now().empty();  // "Undo: school 3 accepted"
    EXPECT_TRUE(made_now || in_language(shown->text())) << action.id << ": " << shown->text().toStdString();
    EXPECT_TRUE(in_language(shown->toolTip())) << action.id;
  }
  for (auto* one : window_->findChildren<QDockWidget*>()) {
    EXPECT_TRUE(in_language(one->windowTitle())) << one->windowTitle().toStdString();
  }
  Lines left = english(*window_);
  for (const Action& action : app_->actions.list()) {
    if (!action.text_now) continue;  // else a button says what was made now: "Play (2 pings/s)"
    std::erase_if(left, [&](const std::string& one) { return one.ends_with(": " + action.text_now()); });
  }
  EXPECT_THAT(left, IsEmpty());
}

/// What a translator is given.
std::set<std::string> template_texts() {
  QProcess tool;
  tool.start(qEnvironmentVariable("SONAR_SOURCE") + "/tools/make_translation_template",
             {qEnvironmentVariable("SONAR_EXPLORER")});
  EXPECT_TRUE(tool.waitForFinished());
  EXPECT_EQ(tool.exitCode(), 0) << tool.readAllStandardError().toStdString();
  std::set<std::string> out;
  QXmlStreamReader xml(tool.readAllStandardOutput());
  while (!xml.atEnd()) {
    if (xml.readNext() == QXmlStreamReader::StartElement && xml.name() == u"source")
      out.insert(xml.readElementText().toStdString());
  }
  EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
  return out;
}

TEST_F(InAnotherLanguage, ATranslatorIsGivenWhateverTheWindowAsksFor) {
  ASSERT_GT(brackets_.asked().size(), 500U);
  const std::set<std::string> given = template_texts();
  Lines missing;
  std::set_difference(brackets_.asked().begin(), brackets_.asked().end(), given.begin(), given.end(),
                      std::back_inserter(missing));
  EXPECT_THAT(missing, IsEmpty());
}

TEST_F(InAnotherLanguage, DialogsSpeakIt) {
  in_every_dialog([](QDialog& dialog) {
    EXPECT_THAT(english(dialog), IsEmpty()) << dialog.objectName().toStdString();
    EXPECT_TRUE(in_language(dialog.windowTitle())) << dialog.windowTitle().toStdString();
  });
  QWidget* batch = batch_window();
  ASSERT_NE(batch, nullptr);
  EXPECT_THAT(english(*batch), IsEmpty());
}

}  // namespace
}  // namespace sonar
