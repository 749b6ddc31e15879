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

/// A window of its own beside the main one: choices at the left, results in tabs at the right, buttons below.
class PageWindow : public QWidget {
 public:
  /// The app outlives the window.
  PageWindow(AppModel& app, const char* name, const char* title);
  void come_to_front();

 protected:
  [[nodiscard]] AppModel& app() { return app_; }
  [[nodiscard]] QVBoxLayout& choices() { return *choices_; }
  /// Parent of what stands among the choices.
  [[nodiscard]] QWidget* inside() { return inside_; }
  [[nodiscard]] QTabWidget& results() { return *results_; }
  [[nodiscard]] QHBoxLayout& foot() { return *foot_; }
  QPushButton* add_button(QBoxLayout& row, const char* name, const char* text, const char* tip,
                          std::function<void()> pressed);
  void add_picture(LivePicture& picture, const char* name, const char* title);
  void add_rows(Rows& rows, const char* name, const char* title);
  /// After all choices.
  void end_choices();
  /// The results go before the pictures that they show: for the end of a window that owns some.
  void end_results() { delete std::exchange(results_, nullptr); }
  /// A line below the results; empty = none.
  void tell(const std::string& line);
  void tell(const Result<void>& done) { tell(done ? std::string() : to_line(done.error())); }
  /// Asks for a folder and tells how writing into it went.
  void write_into(const char* title, const std::function<Result<void>(const std::string& folder)>& write);

 private:
  AppModel& app_;
  QWidget* inside_ = nullptr;
  QVBoxLayout* choices_ = nullptr;
  QTabWidget* results_ = nullptr;
  QHBoxLayout* foot_ = nullptr;
  QLabel* told_ = nullptr;
};

}  // namespace sonar
