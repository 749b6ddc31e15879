// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>
#include <QSize>
#include <memory>
#include <optional>
#include <string>

#include "gui/animation_timer.h"
#include "session/app_model.h"
#include "session/listening.h"

namespace sonar {

class BatchWindow;
class BiomassWindow;
class IntegrationWindow;

/// Of a window at its first start: nine tenths of what the screen has to give, within 1280 x 800 and 3840 x 2160, and no more
/// than there is.
[[nodiscard]] QSize first_size(const QSize& available);

/// Composes docks, menus and the status line from an app; has no behaviour of its own.
class MainWindow : public QMainWindow {
 public:
  /// The app outlives the window.
  /// at_first  its size; empty = as first_size() has it for its screen
  explicit MainWindow(AppModel& app, std::optional<QSize> at_first = {});
  ~MainWindow() override;
  MainWindow(const MainWindow&) = delete;
  MainWindow& operator=(const MainWindow&) = delete;

  /// Docks and size as text, for the preferences.
  [[nodiscard]] std::string layout() const;
  /// What layout() gave on a screen of about this size; anything else changes nothing.
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
  std::unique_ptr<BatchWindow> batch_;  ///< null until it is asked for
  std::unique_ptr<IntegrationWindow> integration_;
  std::unique_ptr<BiomassWindow> biomass_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
