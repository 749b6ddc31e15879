// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QWidget>
#include <functional>
#include <string>
#include <utility>

#include "base/result.h"
#include "session/app_model.h"

namespace sonar {

/// A window of its own beside the main one, in which the program goes on when it is closed.
class OwnWindow : public QWidget {
 public:
  /// The app outlives the window.
  OwnWindow(AppModel& app, const char* name, const char* title);
  void come_to_front();

 protected:
  [[nodiscard]] AppModel& app() { return app_; }
  QPushButton* add_button(QBoxLayout& row, const char* name, const char* text, const char* tip,
                          std::function<void()> pressed);
  /// Where it tells; to be laid out.
  [[nodiscard]] QLabel* told() { return told_; }
  /// A line, where told() stands; empty = none.
  void tell(const std::string& line);
  void tell(const Result<void>& done) { tell(done ? std::string() : to_line(done.error())); }

 private:
  AppModel& app_;
  QLabel* told_ = nullptr;
};

/// Choices at the left, results in tabs at the right, what is told and buttons below.
class PageWindow : public OwnWindow {
 public:
  PageWindow(AppModel& app, const char* name, const char* title);

 protected:
  [[nodiscard]] QVBoxLayout& choices() { return *choices_; }
  /// Parent of what stands among the choices.
  [[nodiscard]] QWidget* inside() { return inside_; }
  [[nodiscard]] QTabWidget& results() { return *results_; }
  [[nodiscard]] QHBoxLayout& foot() { return *foot_; }
  void add_picture(LivePicture& picture, const char* name, const char* title);
  void add_rows(Rows& rows, const char* name, const char* title);
  /// After all choices.
  void end_choices();
  /// The results go before the pictures that they show: for the end of a window that owns some.
  void end_results() { delete std::exchange(results_, nullptr); }
  /// Asks for a folder and tells how writing into it went.
  void write_into(const char* title, const std::function<Result<void>(const std::string& folder)>& write);

 private:
  QWidget* inside_ = nullptr;
  QVBoxLayout* choices_ = nullptr;
  QTabWidget* results_ = nullptr;
  QHBoxLayout* foot_ = nullptr;
};

}  // namespace sonar
