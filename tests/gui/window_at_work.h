// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QDialog>
#include <QDockWidget>
#include <QPixmap>
#include <QTest>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "gate.h"
#include "gui/main_window.h"
#include "gui/picture_view.h"
#include "gui/queue_pump.h"
#include "session/slices/slice_model.h"
#include "session/test_survey.h"
#include "session/tools/seed_tool.h"

namespace sonar {

/// The real window on a small simulated survey, driven through the platform's own events. Nothing sleeps: settle() turns
/// the loop until nothing waits in the background.
class WindowAtWork : public testing::Test {
 protected:
  void SetUp() override { open(); }
  void TearDown() override {
    // For whoever looks into a failure: the window as it was at the end.
    keep_picture(testing::UnitTest::GetInstance()->current_test_info()->name());
    close();
  }

  void open();
  void close();
  /// The window as it is now, in the folder that SONAR_GUI_PICTURES names; nothing where it names none.
  void keep_picture(const std::string& name);
  /// Whether a picture has more than a few colours: it is of something.
  [[nodiscard]] static bool shows_something(const QPixmap& picture);

  [[nodiscard]] Document& document() { return app_->workspace.document; }
  [[nodiscard]] Workspace& workspace() { return app_->workspace; }

  /// Until an event, a job and a picture more bring nothing more.
  void settle();
  /// The same while something goes on by itself.
  void settle_jobs();

  [[nodiscard]] QWidget* view(const std::string& dock) {
    return window_->findChild<QWidget*>(QString::fromStdString(dock + ".view"));
  }
  [[nodiscard]] QDockWidget* dock(const std::string& id) {
    return window_->findChild<QDockWidget*>(QString::fromStdString(id));
  }
  /// In front of the docks that share its place.
  void raise(const std::string& id) {
    dock(id)->raise();
    settle();
  }

  // --- a user's hands
  /// In the window's own coordinates, as the platform has them.
  [[nodiscard]] QPoint in_window(QWidget* widget, PixelPoint at) const {
    return widget->mapTo(window_.get(), QPoint(static_cast<int>(at.x), static_cast<int>(at.y)));
  }
  void move(const std::string& dock, PixelPoint to) { move_on(view(dock), to); }
  void move_on(QWidget* widget, PixelPoint to) {
    QTest::mouseMove(window_->windowHandle(), in_window(widget, to));
    settle();
  }
  void click(const std::string& dock, PixelPoint at, Qt::KeyboardModifiers keys = {}) {
    click_on(view(dock), at, keys);
  }
  void click_on(QWidget* widget, PixelPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(window_->windowHandle(), Qt::LeftButton, keys, in_window(widget, at));
    settle();
  }
  void double_click(const std::string& dock, PixelPoint at) {
    QTest::mouseDClick(window_->windowHandle(), Qt::LeftButton, {}, in_window(view(dock), at));
    settle();
  }
  void press_on(QWidget* widget, PixelPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mousePress(window_->windowHandle(), Qt::LeftButton, keys, in_window(widget, at));
    settle();
  }
  void release_on(QWidget* widget, PixelPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseRelease(window_->windowHandle(), Qt::LeftButton, keys, in_window(widget, at));
    settle();
  }
  /// Pressed at one place, moved over the middle, released at another.
  void drag(const std::string& dock, PixelPoint from, PixelPoint to, Qt::KeyboardModifiers keys = {}) {
    press_on(view(dock), from, keys);
    move(dock, {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)});
    move(dock, to);
    release_on(view(dock), to, keys);
  }
  /// Held with the middle button: what is zoomed is moved.
  void middle_drag(const std::string& dock, PixelPoint from, PixelPoint to) {
    QTest::mousePress(window_->windowHandle(), Qt::MiddleButton, {}, in_window(view(dock), from));
    move(dock, to);
    QTest::mouseRelease(window_->windowHandle(), Qt::MiddleButton, {}, in_window(view(dock), to));
    settle();
  }
  void wheel(const std::string& dock, PixelPoint at, int steps, Qt::KeyboardModifiers keys = {});
  void key(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(window_->windowHandle(), key, keys);
    settle();
  }
  /// What opens a dialog, and hands upon that. One that they leave open fails the test, and does not hold it for ever.
  void with_dialog(const std::function<void()>& opens, const std::function<void(QDialog&)>& hands);
  /// A control of the panel; its section is unfolded by a click where it is folded.
  template <class Control>
  Control& control(const char* section, const char* name) {
    unfold(section);
    auto* found = view("controls")->findChild<Control*>(name);
    if (found == nullptr || !found->isVisible()) throw std::runtime_error(std::string("no control is seen: ") + name);
    found->setFocus(Qt::TabFocusReason);
    return *found;
  }
  void unfold(const char* section);
  void type(const std::string& text) {
    for (const char letter : text) QTest::keyClick(window_->windowHandle(), letter);
    settle();
  }

  /// A bright voxel of a school, found without the window, with the slices laid through it.
  struct Target {
    std::int64_t ping = 0;
    Voxel voxel;
  };
  Target look_at_school();
  [[nodiscard]] PixelPoint place_in(const std::string& dock, const Voxel& voxel);
  /// Masks of the only school, by ping.
  [[nodiscard]] const std::vector<SchoolMasks::InPing>& masks() {
    return document().state().schools.at(0)->masks.pings;
  }

  std::filesystem::path survey_ = TestSurvey::easy().folder();  ///< empty = none is opened
  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  std::filesystem::path cache_;  ///< of the user; empty = there is none
  Recipe recipe_;                ///< that the window works under
  Preferences preferences_;
  Gate gate_;
  std::unique_ptr<QueuePump> pump_;
  std::unique_ptr<AppModel> app_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace sonar
