// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QComboBox>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QSpinBox>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "gui/batch_table.h"
#include "gui/page_window.h"
#include "session/listening.h"

namespace sonar {

/// Surveys that are run one after another, in a window of its own beside the main one: work goes on there meanwhile.
class BatchWindow : public OwnWindow {
 public:
  /// Both outlive the window. main  comes to the front when a survey is opened
  BatchWindow(AppModel& app, QWidget& main);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] QWidget* upper_half();
  [[nodiscard]] QWidget* lower_half();
  void add_recipe_row(QBoxLayout& column);
  void add_run_row(QBoxLayout& column);

  void add_paths(const std::vector<std::filesystem::path>& paths);
  void choose_out();
  void choose_recipe(int choice);
  void move(bool later);
  void remove();
  void open_current();
  void save_log();
  void follow(BatchChange change);
  void show_recipe();
  void show_state();
  void show_log();

  Batch& batch_;
  QWidget& main_;
  BatchTable* table_;
  QComboBox* recipe_ = new QComboBox(this);
  QLabel* recipe_file_ = new QLabel(this);
  QSpinBox* jobs_ = new QSpinBox(this);
  QProgressBar* total_ = new QProgressBar(this);
  QPlainTextEdit* log_ = new QPlainTextEdit(this);
  QPushButton* open_window_ = nullptr;
  QPushButton* remove_ = nullptr;
  QPushButton* earlier_ = nullptr;
  QPushButton* later_ = nullptr;
  QPushButton* out_ = nullptr;
  QPushButton* open_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* stop_ = nullptr;
  std::size_t lines_shown_ = 0;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
