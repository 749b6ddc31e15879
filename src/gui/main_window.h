// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>
#include <string>

#include "gui/animation_timer.h"
#include "session/app_model.h"

namespace sonar {

/// Composes docks, menus and the status line from an app; has no behaviour of its own.
class MainWindow : public QMainWindow {
 public:
  /// The app outlives the window.
  explicit MainWindow(AppModel& app);
  ~MainWindow() override;

  /// Docks and size as text, for the preferences.
  [[nodiscard]] std::string layout() const;
  /// What layout() gave; anything else changes nothing.
  void take_layout(const std::string& layout);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void bind_switch(QDockWidget& dock, const std::string& name);
  void answer();
  void show_title();

  AppModel& app_;
  AnimationTimer animations_;
};

}  // namespace sonar
