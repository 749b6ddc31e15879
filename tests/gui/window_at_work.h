// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QDockWidget>
#include <QTest>
#include <filesystem>
#include <memory>
#include <string>

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
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    if (!folder.isEmpty()) window_->grab().save(folder + "/" + test->name() + ".png");
    close();
  }

  void open() {
    pump_ = std::make_unique<QueuePump>();
    desk_ = std::make_unique<Desk>(pump_->queue(), TestSurvey::options(journal_));
    window_ = std::make_unique<MainWindow>(*desk_);
    window_->show();
    window_->activateWindow();  // keys go to the window that is active
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    document().open({survey_});
    settle();
  }
  void close() {
    window_.reset();
    desk_.reset();
    pump_.reset();
  }

  [[nodiscard]] Document& document() { return desk_->workspace.document; }

  /// Until an event, a job and a picture more bring nothing more.
  void settle() {
    for (int quiet = 0; quiet < 3; ++quiet) {
      QApplication::sendPostedEvents();
      QApplication::processEvents();
      document().settle();
      for (PictureDock& dock : desk_->pictures) dock.picture->wait();
      desk_->transfer->wait();
      desk_->seed_tool->wait();
      while (desk_->pulse.running()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
      if (pump_->queue().drain() > 0) quiet = -1;
    }
  }

  [[nodiscard]] QWidget* view(const std::string& dock) {
    return window_->findChild<QWidget*>(QString::fromStdString(dock + ".view"));
  }
  /// In the window's own coordinates, as the platform has them.
  [[nodiscard]] QPoint in_window(QWidget* widget, PixelPoint at) const {
    return widget->mapTo(window_.get(), QPoint(static_cast<int>(at.x), static_cast<int>(at.y)));
  }
  void move(const std::string& dock, PixelPoint to) {
    QTest::mouseMove(window_->windowHandle(), in_window(view(dock), to));
    settle();
  }
  void click(const std::string& dock, PixelPoint at, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(window_->windowHandle(), Qt::LeftButton, keys, in_window(view(dock), at));
    settle();
  }
  void double_click(const std::string& dock, PixelPoint at) {
    QTest::mouseDClick(window_->windowHandle(), Qt::LeftButton, {}, in_window(view(dock), at));
    settle();
  }
  void key(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(window_->windowHandle(), key, keys);
    settle();
  }

  /// A bright voxel of a school, found without the window, with the slices laid through it.
  struct Target {
    std::int64_t ping = 0;
    Voxel voxel;
  };
  Target look_at_school();
  [[nodiscard]] PixelPoint place_in(const std::string& dock, const Voxel& voxel) {
    const auto* slice = dynamic_cast<SliceModel*>(desk_->picture(dock));
    EXPECT_NE(slice, nullptr);
    const auto place = slice->picture()->place_of(voxel);
    EXPECT_TRUE(place);
    return place.value_or(PixelPoint{});
  }

  std::filesystem::path survey_ = TestSurvey::easy().folder();
  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  std::unique_ptr<QueuePump> pump_;
  std::unique_ptr<Desk> desk_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace sonar
