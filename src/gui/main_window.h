// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>
#include <string>

#include "gui/pulse_timer.h"
#include "session/desk.h"

namespace sonar {

/// Composes docks, menus and the status line from a desk; has no behaviour of its own.
class MainWindow : public QMainWindow {
 public:
  /// The desk outlives the window.
  explicit MainWindow(Desk& desk);
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

  Desk& desk_;
  PulseTimer pulse_;
};

}  // namespace sonar
